#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/core/case_store.h"

namespace vicon::viewer {

/// A reader's changes of a case's markers: each is saved at once, and can be undone and redone. A marker that somebody
/// else has changed meanwhile is never overwritten: the change throws Error{bad_input} saying so, nothing is written.
class MarkerHistory {
public:
    explicit MarkerHistory(std::string case_id) : case_id_(std::move(case_id)) {}

    /// Saves a new marker (its id is given by the store).
    Marker add(CaseStore& store, const Marker& marker);
    /// @param before the marker as the reader saw it
    Marker change(CaseStore& store, const Marker& before, const Marker& after);
    void remove(CaseStore& store, const Marker& before);

    bool canUndo() const { return done_ > 0; }
    bool canRedo() const { return done_ < changes_.size(); }
    /// Do nothing where there is nothing to undo or redo.
    void undo(CaseStore& store);
    void redo(CaseStore& store);

private:
    struct Change {
        std::optional<Marker> before, after;
    };
    std::optional<Marker> put(CaseStore& store, const std::optional<Marker>& expected,
                              const std::optional<Marker>& wanted) const;
    void remember(Change change);

    std::string case_id_;
    std::vector<Change> changes_;
    std::size_t done_ = 0;  // the changes that are in force
};

}  // namespace vicon::viewer
