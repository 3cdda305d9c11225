#include "bench/steppers/model/stepped.hpp"

#include <vector>

#include "base/failure.hpp"
#include "bench/rows/row.hpp"
#include "glsum/model/stepper.hpp"

namespace generate {

class SteppedModel::Stepping {
public:
    explicit Stepping(const ModelSpec& spec)
        : design(spec.model, spec.writing, spec.memory, spec.step_s, spec.samples) {}
    virtual ~Stepping() = default;
    virtual float step(float input) = 0;
    const drive::RealtimeModel design;

    template <class K>
    class With;
};

template <class K>
class SteppedModel::Stepping::With : public SteppedModel::Stepping {
    using Stepper = glsum::Stepper<K>;

public:
    explicit With(const ModelSpec& spec) : Stepping(spec) {
        const glsum::ModelDesign& numbers = design.design();
        std::size_t coefficients = 0;
        std::size_t samples = 0;
        for (const glsum::PastTable& one : numbers.tables) {
            coefficients += Stepper::table_count(one);
            samples += Stepper::past_count(one);
        }
        table_.resize(coefficients);
        past_.resize(samples);
        waiting_.resize(Stepper::line_count(numbers.delay));
        if (const glsum::Status status = Stepper::prepare(state_, numbers, table_, past_, waiting_);
            status != glsum::Status::ok) {
            throw glsum::Failure(glsum::Exit::bad_input, "the model: " + bench::to_text(status));
        }
    }
    float step(float input) override { return Stepper::step(state_, input); }

private:
    typename Stepper::State state_;
    std::vector<float> table_;
    std::vector<float> past_;
    std::vector<float> waiting_;
};

SteppedModel::SteppedModel(const ModelSpec& spec) {
    if (spec.compensated) {
        stepper_ = std::make_unique<Stepping::With<glsum::modes_compensated_f32>>(spec);
    } else {
        stepper_ = std::make_unique<Stepping::With<glsum::modes_plain_f32>>(spec);
    }
}

SteppedModel::~SteppedModel() = default;

float SteppedModel::step(float input) { return stepper_->step(input); }

const drive::RealtimeModel& SteppedModel::design() const { return stepper_->design; }

}  // namespace generate
