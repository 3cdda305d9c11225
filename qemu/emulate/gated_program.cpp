#include "qemu/emulate/gated_program.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;
using Json = nlohmann::ordered_json;

}  // namespace

std::string to_json(const GatedProgram& program, const std::string& reason) {
    Json json;
    json["schema"] = "glsum-functions-1";
    json["reason"] = reason;
    json["elf_sha256"] = program.elf_sha256;
    json["core"] = program.core;
    json["core_sha256"] = program.core_sha256;
    json["functions"] = Json::array();
    for (const GatedFunction& one : program.functions) {
        Json row{{"function", one.name}, {"calls", one.calls}, {"code_bytes", one.code_bytes}};
        if (one.calls > 0) {
            row["instructions"] = {{"median", one.instructions_median}, {"max", one.instructions_max}};
            row["model_cycles"] = {
                {"median", one.cycles_median}, {"max", one.cycles_max}, {"low", one.low}, {"high", one.high}};
            row["stack_bytes"] = one.stack_bytes;
            row["stalls"] = one.stalls;
        }
        json["functions"].push_back(row);
    }
    return json.dump(1) + "\n";
}

GatedProgram parse_gated_program(const std::string& text, const std::string& name) {
    try {
        const Json json = Json::parse(text);
        if (json.at("schema") != "glsum-functions-1") {
            throw Failure(Exit::bad_input, name + ": expected the schema glsum-functions-1");
        }
        GatedProgram program{json.at("elf_sha256"), json.at("core"), json.at("core_sha256"), {}};
        for (const Json& row : json.at("functions")) {
            GatedFunction one;
            one.name = row.at("function");
            one.calls = row.at("calls");
            one.code_bytes = row.at("code_bytes");
            if (one.calls > 0) {
                one.instructions_median = row.at("instructions").at("median");
                one.instructions_max = row.at("instructions").at("max");
                const Json& model = row.at("model_cycles");
                one.cycles_median = model.at("median");
                one.cycles_max = model.at("max");
                one.low = model.at("low");
                one.high = model.at("high");
                one.stack_bytes = row.at("stack_bytes");
                one.stalls = row.at("stalls").get<std::map<std::string, double>>();
            }
            program.functions.push_back(std::move(one));
        }
        return program;
    } catch (const nlohmann::json::exception& error) {
        throw Failure(Exit::bad_input, fmt::format("{}: no baseline of functions: {}", name, error.what()));
    }
}

}  // namespace qemu
