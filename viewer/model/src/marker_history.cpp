#include "vicon/viewer/model/marker_history.h"

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

/// When a marker was last written does not make it another one.
bool same(const std::optional<Marker>& a, const std::optional<Marker>& b)
{
    if (!a || !b)
        return !a && !b;
    auto x = toJson(*a), y = toJson(*b);
    x.erase("changed");
    y.erase("changed");
    return x == y;
}

std::optional<Marker> stored(CaseStore& store, const std::string& case_id, const std::string& id)
{
    const auto all = store.markers(case_id);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Marker& m) { return m.id == id; });
    return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::optional<Marker> MarkerHistory::put(CaseStore& store, const std::optional<Marker>& expected,
                                         const std::optional<Marker>& wanted) const
{
    store.requireCase(case_id_);
    const std::string id = expected ? expected->id : wanted->id;
    if (!id.empty() && !same(stored(store, case_id_, id), expected))
        throw Error(ErrorCode::bad_input, "another reader changed this marker meanwhile; nothing was written", id,
                    "look at the list, which shows it as it is now, and do it again if you still want it");
    if (wanted)
        return store.saveMarker(case_id_, *wanted);
    store.removeMarker(case_id_, id);
    return std::nullopt;
}

void MarkerHistory::remember(Change change)
{
    changes_.resize(done_);
    changes_.push_back(std::move(change));
    ++done_;
}

Marker MarkerHistory::add(CaseStore& store, const Marker& marker)
{
    Change change{std::nullopt, put(store, std::nullopt, marker)};
    remember(change);
    return *change.after;
}

Marker MarkerHistory::change(CaseStore& store, const Marker& before, const Marker& after)
{
    Change change{before, put(store, before, after)};
    remember(change);
    return *change.after;
}

void MarkerHistory::remove(CaseStore& store, const Marker& before)
{
    remember({before, put(store, before, std::nullopt)});
}

void MarkerHistory::undo(CaseStore& store)
{
    if (!canUndo())
        return;
    const Change& change = changes_[done_ - 1];
    put(store, change.after, change.before);
    --done_;
}

void MarkerHistory::redo(CaseStore& store)
{
    if (!canRedo())
        return;
    const Change& change = changes_[done_];
    put(store, change.before, change.after);
    ++done_;
}

}  // namespace vicon::viewer
