#pragma once

#include <optional>
#include <vector>

#include "vicon/viewer/model/step_number.h"
#include "vicon/viewer/qt/reading_room.h"

namespace vicon::viewer {

/// What a reader said about the lumen of a case's scans and about their bridges; each can be undone and redone. What
/// another reader has changed meanwhile is never overwritten: the step is then forgotten, and Error{bad_input} says so.
class CorrectionHistory {
public:
    /// One of two: corrections of a scan, or the verdict on a bridge.
    struct Step {
        ScanRecord scan;
        std::optional<Corrections> before, after;
        std::optional<ReviewedBridge> bridge_before, bridge_after;
        StepNumber number = 0;

        bool ofBridge() const { return bridge_after.has_value(); }
    };

    explicit CorrectionHistory(const ReadingServices& services) : services_(services) {}

    /// Adds a correction to those that the scan has.
    Step correct(CaseStore& store, const ScanRecord& scan, Correction kind, Point3 point);
    Step forget(CaseStore& store, const ScanRecord& scan);
    Step review(CaseStore& store, const ScanRecord& scan, const ReviewedBridge& bridge, bool confirmed);
    /// What was undone or redone. There must be something.
    Step undo(CaseStore& store);
    Step redo(CaseStore& store);
    std::optional<StepNumber> toUndo() const;
    std::optional<StepNumber> toRedo() const;

private:
    Step take(CaseStore& store, Step step);
    void apply(CaseStore& store, Step& step, bool back);

    ReadingServices services_;
    std::vector<Step> steps_;
    std::size_t done_ = 0;  // the steps that are in force
};

}  // namespace vicon::viewer
