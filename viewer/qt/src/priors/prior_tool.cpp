#include "priors/prior_tool.h"

#include <algorithm>

#include "priors/prior_panel.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

PriorTool::PriorTool(Reading& reading, const ReadingServices& services, const std::string& case_id)
    : ReadingTool(reading), options_(services.priors.options), books_(services, case_id, this), panel_(new PriorPanel)
{
}

void PriorTool::addTo(ReadingLayout& layout)
{
    layout.addList(panel_, tr("Priors"));
    layout.addAction(ReadingMenu::view, tr("Prior, same place"), QKeySequence("Shift+C"), [this] { showSamePlace(); });
    connect(&layout, &ReadingLayout::listShown, this, [this](const QWidget* list) {
        if (list == panel_)
            books_.refresh();
    });
    connectBooks();
    connectPanel();
}

void PriorTool::connectBooks()
{
    connect(&books_, &PriorBooks::shown, this, [this](const PriorPage& page) {
        page_ = page;
        panel_->show(page);
        if (reading_.scan())
            reading_.moved(true);
    });
    connect(&books_, &PriorBooks::said, &reading_, &Reading::say);
    connect(&books_, &PriorBooks::warned, &reading_, &Reading::warn);
}

void PriorTool::connectPanel()
{
    connect(panel_, &PriorPanel::flyWanted, this, &PriorTool::fly);
    connect(panel_, &PriorPanel::confirmWanted, this,
            [this](const std::string& today, std::size_t report, std::size_t finding, bool confirmed) {
                const PriorReport& prior = page_.list.reports[report];
                books_.say(today, prior.sop_uid, prior.findings[finding].uid, confirmed);
            });
    connect(panel_, &PriorPanel::takeBackWanted, this,
            [this](const std::string& today, std::size_t report, std::size_t finding) {
                const PriorReport& prior = page_.list.reports[report];
                books_.takeBack(today, prior.sop_uid, prior.findings[finding].uid);
            });
}

void PriorTool::scanOpened(const Arrival&)
{
    books_.refresh();
}

void PriorTool::markersChanged()
{
    if (panel_->isVisible())
        books_.refresh();
}

void PriorTool::annotate(SnapshotRequest& request, const OpenScan& scan) const
{
    for (const ScanColon& colon : page_.colons)
        if (colon.scan_id == scan.record.id)
            for (PriorPlace& place : priorPlacesIn(page_.list, colon, scan.files.skeleton(), options_))
                request.priors.push_back(std::move(place));
}

void PriorTool::fly(std::size_t report, std::size_t finding)
{
    const OpenScan* scan = reading_.scan();
    const PriorReport& prior = page_.list.reports.at(report);
    for (const ScanColon& colon : page_.colons)
        if (scan && colon.scan_id == scan->record.id)
            if (const auto place = expectedIn(prior, prior.findings.at(finding), colon, options_)) {
                const double station = std::clamp(place->station_mm, 0.0, colon.length_mm);
                const ViewPose view = poseAtStation(scan->files.frames(), scan->lumen, station, Heading::caecum);
                reading_.lookFrom(view, scan->files.skeleton().at(station).position_mm);
                reading_.say(tr("It should lie within %1 mm of here, by %2")
                                 .arg((place->most_mm - place->least_mm) / 2, 0, 'f', 0)
                                 .arg(QString::fromStdString(place->by)));
                return;
            }
    reading_.warn(
        tr("The earlier report does not say where in the colon it lies, or the segments of this colon are not "
           "known."));
}

void PriorTool::showSamePlace()
{
    CaseSession& session = reading_.session();
    if (!reading_.scan())
        return;
    if (session.besideIsPrior()) {
        session.closeBeside();
        return;
    }
    if (page_.images.empty()) {
        reading_.warn(page_.list.reports.empty()
                          ? tr("There is no earlier report of this patient.")
                          : tr("The images of the earlier examination are not in this store, or not prepared; 'vicon "
                               "retrieve' fetches them."));
        return;
    }
    const BodyPosition position = bodyPositionFrom(reading_.scan()->record.series.patient_position);
    const auto same = std::find_if(page_.images.begin(), page_.images.end(), [&](const PriorImages& one) {
        return one.record.id == page_.images.front().record.id &&
               bodyPositionFrom(one.scan.series.patient_position) == position;
    });
    const PriorImages& images = same == page_.images.end() ? page_.images.front() : *same;
    reading_.say(tr("Reading the earlier examination ..."));
    session.openPriorBeside(images.record, images.scan, images.folder);
}

}  // namespace vicon::viewer
