#include "drive/model_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "drive/controller.hpp"

namespace drive {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

std::string shortened(const Json& value) { return value.dump().substr(0, 60); }

// The object's fields; each that is taken is gone, so that what is left is not ours.
class Fields {
public:
    Fields(Json object, std::string name) : object_(std::move(object)), name_(std::move(name)) {
        if (!object_.is_object()) {
            refuse(fmt::format("{}: expected an object, found {}", name_, shortened(object_)));
        }
    }

    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const std::string& name() const { return name_; }

    Json take(const char* key) {
        if (!has(key)) {
            refuse(fmt::format("{}: expected the field {}", name_, key));
        }
        Json value = object_[key];
        object_.erase(key);
        return value;
    }

    double number(const char* key) {
        const Json value = take(key);
        if (!value.is_number()) {
            refuse(fmt::format("{}: {}: expected a number, found {}", name_, key, shortened(value)));
        }
        return value.get<double>();
    }

    double number_or(const char* key, double otherwise) { return has(key) ? number(key) : otherwise; }

    std::vector<Term> terms(const char* key) {
        const Json list = take(key);
        if (!list.is_array()) {
            refuse(fmt::format("{}: {}: expected an array of {{\"coefficient\", \"order\"}}, found {}", name_, key,
                               shortened(list)));
        }
        std::vector<Term> terms;
        for (const Json& item : list) {
            Fields fields(item, fmt::format("{}: {}[{}]", name_, key, terms.size()));
            terms.push_back({fields.number("coefficient"), fields.number("order")});
            fields.refuse_rest();
        }
        return terms;
    }

    void refuse_rest() const {
        if (!object_.empty()) {
            refuse(fmt::format("{}: expected coefficient and order alone, found {}", name_, object_.begin().key()));
        }
    }

    [[nodiscard]] std::string rest() const { return object_.empty() ? "" : object_.dump(); }

private:
    Json object_;
    std::string name_;
};

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

Json parse_file(const std::string& text, const std::string& name) {
    try {
        return Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) {
            if (depth > 8) {
                refuse(fmt::format("{}: expected a model, found values nested {} deep", name, depth));
            }
            return true;
        });
    } catch (const Json::parse_error& error) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        const bool cut = text.find_last_not_of(" \t\r\n") == std::string::npos || error.byte > text.size();
        refuse(fmt::format(
            "{}:{}: {}", name, 1 + std::count(text.begin(), end, '\n'),
            cut ? "the file ends in the middle; expected a model in JSON"
                : fmt::format("expected JSON, found '{}'", text.substr(error.byte < 12 ? 0 : error.byte - 12, 20))));
    } catch (const Json::out_of_range&) {
        refuse(fmt::format("{}: expected finite numbers, found one beyond double precision", name));
    }
}

}  // namespace

Model parse_model(const std::string& text, const std::string& name) {
    Fields fields(parse_file(text, name), name);
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
            model.numerator = fields.terms("numerator");
        }
        model.denominator = fields.terms("denominator");
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
    Fields fields(parse_file(text, name), name);
    if (!fields.has("kind") || fields.take("kind") != "pid") {
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
