// What a program is called: its line in cli/commands.
#pragma once

namespace cli {

extern const char* const command_name;
extern const char* const command_summary;

}  // namespace cli
