#pragma once

#include "priors/prior_books.h"
#include "reading/reading_tool.h"

namespace vicon::viewer {

class PriorPanel;

/// Earlier reports of the patient beside the case: where their findings should lie today, in projection and slices;
/// what the reader says of them; and the earlier examination's images at the place that is read.
class PriorTool : public ReadingTool {
    Q_OBJECT
public:
    PriorTool(Reading& reading, const ReadingServices& services, const std::string& case_id);

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override;
    void markersChanged() override;
    void annotate(SnapshotRequest& request, const OpenScan& scan) const override;

private:
    void connectBooks();
    void connectPanel();
    void fly(std::size_t report, std::size_t finding);
    /// Shows the earlier examination at the same place, or says why it cannot.
    void showSamePlace();

    const PriorOptions options_;
    PriorBooks books_;
    PriorPanel* panel_;
    PriorPage page_;
};

}  // namespace vicon::viewer
