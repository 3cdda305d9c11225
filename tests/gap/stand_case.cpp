#include "stand_case.hpp"

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "drive/model_file.hpp"
#include "gap/drive/start.hpp"

namespace gap_test {

stand::Stand linear_stand() {
    stand::Stand built;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(built, effect);
    }
    built.interval_s = 0.02;
    built.spread_s = 0.002;
    return built;
}

drive::Form linear_form() {
    return gap::form_of(drive::parse_model(stand::linear_model_json(linear_stand()), "linear stand"));
}

gap::Record log_of(const Sizes& sizes, const Run& run) {
    stand::Stand built = linear_stand();
    for (const auto& [name, value] : sizes) {
        stand::set_size(built, name, value);
    }
    if (run.colour == 0.0) {
        built.noise_rad = run.noise_rad;
    }
    stand::Experiment experiment;
    experiment.name = run.experiment;
    experiment.duty = run.duty;
    experiment.low_duty = run.low_duty;
    experiment.until_s = run.until_s;
    experiment.bit_s = 0.5;
    experiment.to_hz = 1.0;
    const stand::Record made = stand::run(built, experiment, run.seed);
    drive::Log log;
    log.name = made.name;
    log.time_s = made.time_s;
    log.input = made.duty;
    log.output = made.angle_rad;
    if (run.colour > 0.0) {
        boost::random::mt19937_64 engine(run.seed);
        boost::random::normal_distribution<double> normal;
        double noise = 0.0;
        for (double& angle : log.output) {
            noise = run.colour * noise + std::sqrt(1.0 - run.colour * run.colour) * run.noise_rad * normal(engine);
            angle += noise;
        }
    }
    return gap::to_record(std::move(log));
}

gap::Question question_of(const Sizes& sizes, const Run& train, const Run& validate,
                          const std::vector<std::string>& without) {
    return {
        linear_form(), false, {log_of(sizes, train)}, {log_of(sizes, validate)}, std::nullopt, gap::Metric::simulation,
        without,       2};
}

gap::Answer ask(const Sizes& sizes, const Run& train, const Run& validate, const std::vector<std::string>& without) {
    return gap::diagnose(question_of(sizes, train, validate, without), [](const std::string&) {});
}

gap::Answer ask(const Sizes& sizes, std::uint64_t seed, const std::vector<std::string>& without) {
    return ask(sizes, {.seed = 10 * seed + 1}, {.experiment = "prbs", .low_duty = 0.02, .seed = 10 * seed + 2},
               without);
}

std::vector<std::string> names(const gap::Answer& answer) {
    std::vector<std::string> all;
    for (const std::size_t i : answer.decision.effects) {
        all.push_back(answer.ranking[i].trained.name());
    }
    return all;
}

const gap::FreeParameter* find(const gap::Answer& answer, const std::string& name) {
    if (answer.decision.effects.empty()) {
        return nullptr;
    }
    const gap::Ranked& chosen = answer.ranking[answer.decision.effects.front()];
    for (const auto* lists : {&chosen.trained.lasting, &chosen.candidate.own}) {
        for (const auto& list : *lists) {
            for (const gap::FreeParameter& parameter : list) {
                if (parameter.name == name) {
                    return &parameter;
                }
            }
        }
    }
    return nullptr;
}

}  // namespace gap_test
