#include "vicon/viewer/model/marker_history.h"

#include <algorithm>

#include "vicon/cases/marker_groups.h"

namespace vicon::viewer {
namespace {

/// The way back: in reverse order, what was found is what there was.
std::vector<MarkerEdit> inverse(const std::vector<MarkerEdit>& step)
{
    std::vector<MarkerEdit> back;
    std::transform(step.rbegin(), step.rend(), std::back_inserter(back), [](const MarkerEdit& edit) {
        return MarkerEdit{edit.after, edit.before};
    });
    return back;
}

}  // namespace

const std::vector<MarkerEdit>& MarkerHistory::take(CaseStore& store, const std::vector<MarkerEdit>& edits)
{
    std::vector<MarkerEdit> done = store.editMarkers(case_id_, edits);
    steps_.resize(done_);
    steps_.push_back({std::move(done), nextStep()});
    ++done_;
    return steps_.back().edits;
}

std::optional<StepNumber> MarkerHistory::toUndo() const
{
    return canUndo() ? std::optional(steps_[done_ - 1].number) : std::nullopt;
}

std::optional<StepNumber> MarkerHistory::toRedo() const
{
    return canRedo() ? std::optional(steps_[done_].number) : std::nullopt;
}

Marker MarkerHistory::add(CaseStore& store, const Marker& marker)
{
    return *take(store, {{std::nullopt, marker}}).front().after;
}

Marker MarkerHistory::change(CaseStore& store, const Marker& before, const Marker& after)
{
    return *take(store, {{before, after}}).front().after;
}

void MarkerHistory::remove(CaseStore& store, const Marker& before)
{
    take(store, {{before, std::nullopt}});
}

void MarkerHistory::pair(CaseStore& store, const Marker& a, const Marker& b)
{
    take(store, pairingEdits(store.markers(case_id_), a, b));
}

void MarkerHistory::part(CaseStore& store, const Marker& marker)
{
    Marker parted = marker;
    parted.partners.clear();
    take(store, {{marker, parted}});
}

void MarkerHistory::undo(CaseStore& store)
{
    if (!canUndo())
        return;
    std::vector<MarkerEdit>& edits = steps_[done_ - 1].edits;
    edits = inverse(store.editMarkers(case_id_, inverse(edits)));
    --done_;
}

void MarkerHistory::redo(CaseStore& store)
{
    if (!canRedo())
        return;
    std::vector<MarkerEdit>& edits = steps_[done_].edits;
    edits = store.editMarkers(case_id_, edits);
    ++done_;
}

}  // namespace vicon::viewer
