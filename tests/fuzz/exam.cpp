// A manifest, a truth or an answer from anywhere: what is taken can be asked and scored.
#include "gap/exam/manifest.hpp"
#include "gap/exam/score.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::to_text(data, size);
    fuzz::refused_or([&] {
        for (const gap::exam::Asked& asked : gap::exam::parse_manifest(text, "file")) {
            fuzz::expect(!asked.name.empty() && !asked.train.empty() && !asked.base.empty());
            fuzz::expect(asked.name.find('/') == std::string::npos);
        }
    });
    gap::exam::Reply reply = gap::exam::refusal("nothing");
    fuzz::refused_or([&] { reply = gap::exam::parse_reply(text, "file"); });
    gap::exam::Truth truth;
    truth.name = "any";
    std::vector<gap::exam::Scored> scored{gap::exam::score(truth, reply)};
    fuzz::refused_or([&] {
        for (const gap::exam::Truth& known : gap::exam::parse_truth(text, "file")) {
            scored.push_back(gap::exam::score(known, reply));
        }
    });
    fuzz::expect(!gap::exam::to_text(scored).empty());
    fuzz::expect(!gap::exam::to_json(scored).empty());
    return 0;
}
