#pragma once

#include "reading/reading_tool.h"
#include "session/own_store.h"
#include "vicon/cases/pair_proposals.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

class PairPanel;

/// Markers of two scans that may be one finding are proposed; only the reader pairs them.
class PairTool : public ReadingTool {
    Q_OBJECT
public:
    PairTool(Reading& reading, const ReadingServices& services, std::string case_id);

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override;
    void markersChanged() override;

private:
    void refresh();
    void fly(const PairProposal& proposal);
    void confirm(const PairProposal& proposal);

    const std::string case_id_;
    PairPanel* panel_;
    std::string shown_;           // the marker flown to last
    WorkerWith<OwnStore> store_;  // last: it ends first
};

}  // namespace vicon::viewer
