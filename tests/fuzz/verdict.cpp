// A verdict or a sealed truth from anywhere: what is taken can be scored.
#include "drive/stand/blind/score.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::to_text(data, size);
    fuzz::refused_or([&] { fuzz::expect(!stand::blind::parse_answer(text, "file").verdict.empty()); });
    fuzz::refused_or([&] {
        const auto truths = stand::blind::parse_sealed(text, "file");
        const auto score = stand::blind::score(truths, stand::blind::constant_guess(truths.size()));
        fuzz::expect(score.top_one.all == truths.size());
        const std::vector<stand::blind::Scored> scored{{"guess", score}};
        fuzz::expect(!stand::blind::to_text(scored).empty());
    });
    return 0;
}
