// A model file from anywhere: what is taken is a model (or a controller), and is written and taken again as it was.
#include "drive/model_file.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const drive::Model model = drive::parse_model(fuzz::to_text(data, size), "file");
        drive::check_model(model, "file");
        const drive::Model again = drive::parse_model(drive::to_json(model), "again");
        fuzz::expect(again == model);
        fuzz::expect(!drive::to_text(model).empty());
    });
    fuzz::refused_or([&] { drive::check_model(drive::parse_controller(fuzz::to_text(data, size), "file"), "file"); });
    return 0;
}
