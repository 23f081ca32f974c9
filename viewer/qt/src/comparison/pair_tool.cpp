#include "comparison/pair_tool.h"

#include "comparison/pair_panel.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr const char* kPairs = "pairs";
}

PairTool::PairTool(Reading& reading, const ReadingServices& services, std::string case_id)
    : ReadingTool(reading), case_id_(std::move(case_id)), panel_(new PairPanel), store_(this, services.store)
{
    connect(store_.worker(), &Worker::failed, &reading_, &Reading::warn);
}

void PairTool::addTo(ReadingLayout& layout)
{
    layout.addList(panel_, tr("Pairs"));
    connect(&layout, &ReadingLayout::listShown, this, [this](const QWidget* list) {
        if (list == panel_)
            refresh();
    });
    connect(panel_, &PairPanel::flyWanted, this, &PairTool::fly);
    connect(panel_, &PairPanel::confirmWanted, this, &PairTool::confirm);
}

void PairTool::scanOpened(const Arrival&)
{
    markersChanged();
}

void PairTool::markersChanged()
{
    if (panel_->isVisible())
        refresh();
}

void PairTool::refresh()
{
    store_.giveUp(kPairs);
    store_.post(kPairs, [this](OwnStore& store, const Progress& wanted) -> Worker::Work {
        const std::vector<Marker> markers = store().markers(case_id_);
        std::vector<PairProposal> proposals;
        if (mayBePaired(markers))
            proposals = proposePairs(markers, matchesOf(store(), case_id_, &wanted));
        return [this, proposals] { panel_->show(proposals); };
    });
}

void PairTool::fly(const PairProposal& proposal)
{
    const bool is_second = shown_ == proposal.first;
    const auto next = reading_.session().marker(is_second ? proposal.second : proposal.first);
    const auto other = reading_.session().marker(is_second ? proposal.first : proposal.second);
    if (!next)
        return;
    shown_ = next->id;
    reading_.showMarker(*next);
    if (other)
        emit reading_.partnerWanted(*other);
}

void PairTool::confirm(const PairProposal& proposal)
{
    const auto first = reading_.session().marker(proposal.first), second = reading_.session().marker(proposal.second);
    if (first && second)
        reading_.session().pairMarkers(*first, *second);
}

}  // namespace vicon::viewer
