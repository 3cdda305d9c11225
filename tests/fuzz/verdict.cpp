// A verdict, a sealed truth or a case's facts from anywhere: what is taken can be scored, or is a known domain.
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/judge.hpp"
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
        const auto open = stand::blind::score_open(truths, stand::blind::constant_guess(truths.size()));
        fuzz::expect(open.wrong.hits == 0 && !stand::blind::to_json(open).empty());
    });
    fuzz::refused_or([&] { fuzz::expect(!stand::blind::parse_facts(text, "file").domain.empty()); });
    return 0;
}
