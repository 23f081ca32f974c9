#include "corrections/correction_history.h"

#include <algorithm>
#include <tuple>

#include "vicon/core/error.h"

namespace vicon::viewer {

CorrectionHistory::Step CorrectionHistory::take(CaseStore& store, Step step)
{
    apply(store, step, false);
    step.number = nextStep();
    steps_.resize(done_);
    steps_.push_back(std::move(step));
    ++done_;
    return steps_.back();
}

CorrectionHistory::Step CorrectionHistory::correct(CaseStore& store, const ScanRecord& scan, Correction kind,
                                                   Point3 point)
{
    Step step;
    step.scan = scan;
    step.before = step.after = services_.corrections(store, scan);
    step.after->of(kind).push_back(point);
    return take(store, std::move(step));
}

CorrectionHistory::Step CorrectionHistory::forget(CaseStore& store, const ScanRecord& scan)
{
    Step step;
    step.scan = scan;
    step.before = services_.corrections(store, scan);
    step.after = Corrections{};
    if (step.before == step.after)
        throw Error(ErrorCode::wrong_use, "this scan has no corrections");
    return take(store, std::move(step));
}

CorrectionHistory::Step CorrectionHistory::review(CaseStore& store, const ScanRecord& scan,
                                                  const ReviewedBridge& bridge, bool confirmed)
{
    Step step;
    step.scan = scan;
    step.bridge_before = step.bridge_after = bridge;
    step.bridge_after->review = {confirmed ? BridgeVerdict::confirmed : BridgeVerdict::rejected, {}, {}};
    return take(store, std::move(step));
}

void CorrectionHistory::apply(CaseStore& store, Step& step, bool back)
{
    if (!step.ofBridge()) {
        const auto& [from, to] = back ? std::tie(*step.after, *step.before) : std::tie(*step.before, *step.after);
        services_.correct(store, step.scan, from, to);
        return;
    }
    const auto find = [&] {
        const auto all = services_.bridges(store, step.scan);
        const auto found = std::find_if(all.begin(), all.end(), [&](const ReviewedBridge& other) {
            return isSameBridge(other.bridge, step.bridge_before->bridge);
        });
        if (found == all.end())
            throw Error(ErrorCode::not_found, "the scan has no such bridge any more", step.scan.id);
        return *found;
    };
    const ReviewedBridge &expected = back ? *step.bridge_after : *step.bridge_before, now = find();
    if (now.review != expected.review)
        throw Error(ErrorCode::bad_input,
                    "this bridge's verdict was changed by another reader meanwhile; it is left as it is now");
    services_.review_bridge(store, step.scan, back ? *step.bridge_before : *step.bridge_after);
    if (!back)
        step.bridge_after = find();  // with who and when
}

CorrectionHistory::Step CorrectionHistory::undo(CaseStore& store)
{
    if (!toUndo())
        throw Error(ErrorCode::wrong_use, "no correction is left to be undone");
    Step step = steps_[done_ - 1];
    --done_;
    try {
        apply(store, step, true);
    } catch (...) {
        steps_.erase(steps_.begin() + std::ptrdiff_t(done_));
        throw;
    }
    return step;
}

CorrectionHistory::Step CorrectionHistory::redo(CaseStore& store)
{
    if (!toRedo())
        throw Error(ErrorCode::wrong_use, "no correction is left to be done again");
    try {
        apply(store, steps_[done_], false);
    } catch (...) {
        steps_.erase(steps_.begin() + std::ptrdiff_t(done_));
        throw;
    }
    return steps_[done_++];
}

std::optional<StepNumber> CorrectionHistory::toUndo() const
{
    return done_ > 0 ? std::optional(steps_[done_ - 1].number) : std::nullopt;
}

std::optional<StepNumber> CorrectionHistory::toRedo() const
{
    return done_ < steps_.size() ? std::optional(steps_[done_].number) : std::nullopt;
}

}  // namespace vicon::viewer
