#include "bench/texts/guards.hpp"

#include <utility>

#include "bench/texts/template.hpp"

namespace generate {
namespace {

std::string guard(const char* which, const std::string& name, Places places) {
    places["name"] = name;
    places["NAME"] = upper(name);
    HeaderText text{{}, std::move(places), {{"guards", {"guards"}}}};
    return text.section("guards", which);
}

}  // namespace

std::string floating_guard(const std::string& name) {
    return guard("guard floating", name, {{"fp_bit", "4"}, {"fp_register", "t"}});
}

std::string include_guard(const std::string& name, const std::string& design, const std::string& identity) {
    return guard("include guard", name, {{"design", design}, {"identity", identity}});
}

}  // namespace generate
