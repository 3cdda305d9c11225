#include "drive/model_file.hpp"

#include <fmt/format.h>

#include "drive/controller.hpp"
#include "drive/controller_file.hpp"
#include "drive/json_fields.hpp"
#include "drive/refusal.hpp"

namespace drive {
namespace {

std::vector<Term> take_terms(Fields& fields, const char* key) {
    const Json list = fields.take(key);
    if (!list.is_array()) {
        refuse(fmt::format("{}: {}: expected an array of {{\"coefficient\", \"order\"}}, found {}", fields.name(), key,
                           shortened(list)));
    }
    std::vector<Term> terms;
    for (const Json& item : list) {
        Fields term(item, fmt::format("{}: {}[{}]", fields.name(), key, terms.size()));
        terms.push_back({term.number("coefficient"), term.number("order")});
        term.refuse_rest("coefficient and order");
    }
    return terms;
}

Kind take_kind(Fields& fields) {
    const Json value = fields.has("kind") ? fields.take("kind") : Json("fotf");
    for (const Kind kind : {Kind::fotf, Kind::fopdt, Kind::sopdt, Kind::niopdt}) {
        if (value == name_of(kind)) {
            return kind;
        }
    }
    refuse(fmt::format("{}: kind: expected fotf, fopdt, sopdt or niopdt, found {}", fields.name(), shortened(value)));
}

void refuse_field(const Fields& fields, const char* key, Kind kind) {
    if (fields.has(key)) {
        refuse(fmt::format("{}: a model of kind {} has no {}; expected kind fotf or its own fields", fields.name(),
                           name_of(kind), key));
    }
}

Json to_json(const std::vector<Term>& terms) {
    Json list = Json::array();
    for (const Term& term : terms) {
        list.push_back({{"coefficient", term.coefficient}, {"order", term.order}});
    }
    return list;
}

}  // namespace

Model parse_model(const std::string& text, const std::string& name) {
    Fields fields(parse_json(text, name, "a model"), name);
    Model model;
    model.kind = take_kind(fields);
    const double gain = fields.number_or("gain", 1.0);
    const double delay_s = fields.number_or("delay_s", 0.0);
    if (model.kind == Kind::fopdt || model.kind == Kind::sopdt) {
        refuse_field(fields, "numerator", model.kind);
        refuse_field(fields, "denominator", model.kind);
        const double time_constant_s = fields.number("time_constant_s");
        if (!(time_constant_s > 0.0)) {
            refuse(fmt::format("{}: time_constant_s: expected a number above 0, found {}", name, time_constant_s));
        }
        model = model.kind == Kind::fopdt ? make_fopdt(gain, time_constant_s, delay_s)
                                          : make_sopdt(gain, time_constant_s, delay_s);
    } else {
        refuse_field(fields, "time_constant_s", model.kind);
        if (model.kind == Kind::niopdt) {
            refuse_field(fields, "numerator", model.kind);
        } else if (fields.has("numerator")) {
            model.numerator = take_terms(fields, "numerator");
        }
        model.denominator = take_terms(fields, "denominator");
        model.gain = gain;
        model.delay_s = delay_s;
    }
    if (fields.has("sample_time_s")) {
        model.sample_time_s = fields.number("sample_time_s");
    }
    model.notes = fields.rest();
    check_model(model, name);
    return model;
}

Model parse_controller(const std::string& text, const std::string& name) {
    Fields fields(parse_json(text, name, "a controller"), name);
    const Json kind = fields.has("kind") ? fields.take("kind") : Json();
    if (kind == "fopid") {
        return to_model(parse_fopid(text, name).gains, name);
    }
    if (kind != "pid") {
        return parse_model(text, name);
    }
    const Gains gains{fields.number_or("kp", 0.0),
                      fields.number_or("ki", 0.0),
                      fields.number_or("kd", 0.0),
                      fields.number_or("filter_s", 0.0),
                      fields.number_or("integral_order", 1.0),
                      fields.number_or("derivative_order", 1.0)};
    if (!fields.rest().empty()) {
        refuse(fmt::format("{}: expected kp, ki, kd, filter_s, integral_order and derivative_order, found {}", name,
                           fields.rest().substr(0, 60)));
    }
    return to_model(gains, name);
}

std::string to_json(const Model& model) {
    Json file;
    file["kind"] = name_of(model.kind);
    file["gain"] = model.gain;
    if (model.kind == Kind::fopdt || model.kind == Kind::sopdt) {
        // a_1 is the time constant, or twice it: a power of two, so nothing is lost.
        file["time_constant_s"] =
            model.kind == Kind::fopdt ? model.denominator.at(0).coefficient : model.denominator.at(1).coefficient / 2.0;
    } else {
        if (model.kind == Kind::fotf) {
            file["numerator"] = to_json(model.numerator);
        }
        file["denominator"] = to_json(model.denominator);
    }
    file["delay_s"] = model.delay_s;
    if (model.sample_time_s) {
        file["sample_time_s"] = *model.sample_time_s;
    }
    if (!model.notes.empty()) {
        file.update(Json::parse(model.notes));
    }
    return file.dump(2) + "\n";
}

}  // namespace drive
