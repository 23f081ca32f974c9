#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/viewer/model/step_number.h"

namespace vicon::viewer {

/// A reader's changes of a case's markers: each is saved at once, and can be undone and redone. A change of several
/// markers is one step: one transaction, one undo. A marker that somebody else has changed meanwhile is never
/// overwritten: the change throws Error{bad_input} saying so, nothing is written and nothing is remembered.
class MarkerHistory {
public:
    explicit MarkerHistory(std::string case_id) : case_id_(std::move(case_id)) {}

    /// Saves a new marker (its id is given by the store).
    Marker add(CaseStore& store, const Marker& marker);
    /// Several changes as one step.
    void changeAll(CaseStore& store, const std::vector<MarkerEdit>& edits) { take(store, edits); }
    /// What else of the marker was changed meanwhile stays as it is now.
    /// @param before the marker as the reader saw it
    Marker change(CaseStore& store, const Marker& before, const Marker& after);
    /// Takes the pair entry off the marker that it was paired with, too.
    void remove(CaseStore& store, const Marker& before);
    /// The same finding in two scans: each names the other. Who was the partner of one of them is parted.
    /// Throws Error{wrong_use} for two markers of one scan.
    void pair(CaseStore& store, const Marker& a, const Marker& b);
    /// Ends the pair on both sides.
    void part(CaseStore& store, const Marker& marker);

    bool canUndo() const { return done_ > 0; }
    bool canRedo() const { return done_ < steps_.size(); }
    /// When the step that undo() or redo() would take was made; nothing where there is none.
    std::optional<StepNumber> toUndo() const;
    std::optional<StepNumber> toRedo() const;
    /// Do nothing where there is nothing to undo or redo.
    void undo(CaseStore& store);
    void redo(CaseStore& store);

private:
    struct Step {
        std::vector<MarkerEdit> edits;
        StepNumber number = 0;
    };
    const std::vector<MarkerEdit>& take(CaseStore& store, const std::vector<MarkerEdit>& edits);

    std::string case_id_;
    std::vector<Step> steps_;
    std::size_t done_ = 0;  // the steps that are in force
};

}  // namespace vicon::viewer
