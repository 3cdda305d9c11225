// A stand's file from anywhere: what is taken is written, and taken again as it was.
#include "drive/stand/stand.hpp"

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const stand::Stand taken = stand::parse_stand(fuzz::to_text(data, size), "file");
        const std::string text = stand::to_toml(taken);
        const stand::Stand again = stand::parse_stand(text, "again");
        fuzz::expect(stand::to_toml(again) == text);
        fuzz::expect(stand::present_effects(again) == stand::present_effects(taken));
        fuzz::expect(!stand::linear_model_json(taken).empty());
    });
    return 0;
}
