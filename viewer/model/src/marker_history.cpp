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

/// The marker as it is stored, with what a change is about; nothing where others changed that, or the marker's place:
/// what is known of a finding belongs to where it lies.
std::optional<Marker> changed(const Marker& before, const Marker& after, const Marker& stored)
{
    if (!(before.position_mm == after.position_mm) || !(before.position_mm == stored.position_mm))
        return std::nullopt;
    const nlohmann::json seen = toJson(before), wanted = toJson(after);
    nlohmann::json now = toJson(stored);
    const auto at = [](const nlohmann::json& marker, const std::string& key) {
        return marker.value(key, nlohmann::json());
    };
    for (const auto* each : {&seen, &wanted})
        for (const auto& [key, content] : each->items()) {
            if (at(seen, key) == at(wanted, key) || at(now, key) == at(wanted, key))
                continue;
            if (at(now, key) != at(seen, key))
                return std::nullopt;
            now.erase(key);
            if (wanted.contains(key))
                now[key] = wanted[key];
        }
    return markerFromJson(now);
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
    for (const Marker& stored : store.markers(case_id_))
        if (stored.id == before.id)
            if (const auto wanted = changed(before, after, stored))
                return *take(store, {{stored, *wanted}}).front().after;
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
