#include "vicon/viewer/model/marker_history.h"

#include <algorithm>

#include "vicon/core/error.h"

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

Marker named(Marker marker, const std::string& partner)
{
    if (partner.empty())
        marker.extra.erase("pair");
    else
        marker.extra["pair"] = partner;
    return marker;
}

}  // namespace

const MarkerHistory::Step& MarkerHistory::take(CaseStore& store, const Step& step)
{
    Step done = store.editMarkers(case_id_, step);
    steps_.resize(done_);
    steps_.push_back(std::move(done));
    ++done_;
    return steps_.back();
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
    if (a.scan_id == b.scan_id)
        throw Error(ErrorCode::wrong_use, "a pair is one finding in two scans; both markers lie in the same one",
                    a.id + " and " + b.id);
    take(store, {{a, named(a, b.id)}, {b, named(b, a.id)}});
}

void MarkerHistory::part(CaseStore& store, const Marker& marker)
{
    take(store, {{marker, named(marker, "")}});
}

void MarkerHistory::undo(CaseStore& store)
{
    if (!canUndo())
        return;
    Step& step = steps_[done_ - 1];
    step = inverse(store.editMarkers(case_id_, inverse(step)));
    --done_;
}

void MarkerHistory::redo(CaseStore& store)
{
    if (!canRedo())
        return;
    steps_[done_] = store.editMarkers(case_id_, steps_[done_]);
    ++done_;
}

}  // namespace vicon::viewer
