// The page's own files and D3, built in by embed.cmake.
#pragma once

#include <string_view>

namespace bench::report::page_parts {

extern const std::string_view html;  ///< with {{name}} where the other parts go
extern const std::string_view css;
extern const std::string_view js;
extern const std::string_view d3;
extern const std::string_view d3_version;
/// "sha256-<base64>" of the parts, as a content security policy wants them.
extern const std::string_view css_hash, js_hash, d3_hash;

}  // namespace bench::report::page_parts
