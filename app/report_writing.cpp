#include "report_writing.h"

#include <algorithm>
#include <functional>

#include "named_options.h"
#include "report_folder.h"
#include "report_pictures.h"
#include "report_scans.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/picture/png_file.h"
#include "vicon/report/pdf_writer.h"
#include "vicon/report/report_objects.h"
#include "vicon/viewer/scene/display.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// Draws the content's pictures, and makes them ready for the PDF and for objects meanwhile.
/// @param overviews_drawn what else the report takes is begun then: before, all cores make the first picture ready
void drawPictures(
    CaseStore& store, report::ReportContent& content, ReportScans& scans, report::PrintPictures& printed,
    Progress& progress, report::PackedSights* packed = nullptr, const std::function<void()>& overviews_drawn = [] {})
{
    const auto& loose = content.read.loose_markers;
    const PicturesMade made{
        .picture = [&](const std::string& name, const picture::SharedPicture& drawn) { printed.begin(name, drawn); },
        .marker =
            [&](const std::string& marker_id, std::vector<picture::SharedPicture> drawn) {
                if (packed && std::find(loose.begin(), loose.end(), marker_id) == loose.end())
                    packed->begin(marker_id, std::move(drawn));
            }};
    content.scans = drawScans(store, content.read, scans, progress, made);
    overviews_drawn();
    content.markers = drawMarkers(store, content.read, content.scans, scans, progress, made);
}

}  // namespace

namespace {

report::ReportContent contentOfDraft(CaseStore& store, const std::string& case_id)
{
    report::ReportContent content;
    content.read = readCase(store, case_id);
    requireReportable(store, content.read.record);
    content.created = nowUtc();
    content.software_version = VICON_VERSION;
    return content;
}

/// Draws the pictures of a draft once, then its PDF under the number that it shall have.
class DraftDrawing {
public:
    DraftDrawing(CaseStore& store, const Config& config, const std::string& case_id, Progress& progress)
        : options_(config.get<report::ReportOptions>()),
          content_(contentOfDraft(store, case_id)),
          wanted_(progress),
          scans_(store, content_.read, progress)
    {
        drawPictures(store, content_, scans_, printed_, progress);
    }

    std::string pdfNumbered(int number)
    {
        content_.number = number;
        std::string pdf;
        drawn_ = report::drawPdf(content_, pdf, options_, &printed_, wanted_);
        return pdf;
    }
    const report::ReportContent& content() const { return content_; }
    const report::PdfResult& drawn() const { return drawn_; }  ///< of the last PDF

private:
    report::ReportOptions options_;
    report::ReportContent content_;
    const Progress& wanted_;
    viewer::Display display_;  // one for all pictures
    ReportScans scans_;
    report::PrintPictures printed_;
    report::PdfResult drawn_;
};

}  // namespace

WrittenReport writeReport(CaseStore& store, const Config& config, const std::string& case_id, const fs::path& out,
                          Progress& progress)
{
    DraftDrawing drawing(store, config, case_id, progress);
    const WrittenDraft written = writeDraft(store, drawing.content().read.record.id, out,
                                            [&](int number) { return drawing.pdfNumbered(number); });
    return {written.file, written.number, drawing.drawn().pages, drawing.content().markers.size(),
            drawing.drawn().warnings};
}

std::string previewReport(CaseStore& store, const Config& config, const std::string& case_id, Progress& progress)
{
    DraftDrawing drawing(store, config, case_id, progress);
    return drawing.pdfNumbered(nextDraftNumber(store, drawing.content().read.record.id));
}

namespace {

/// The signed version that an amendment takes the place of.
std::optional<ReportVersion> amendedBy(CaseStore& store, const std::string& case_id, const ReportVersion& version)
{
    for (const ReportVersion& earlier : reportVersions(store, case_id))
        if (version.replaces != 0 && earlier.version == version.replaces)
            return earlier;
    return std::nullopt;
}

/// The pictures of the findings, in the order of the report.
std::vector<report::SightPictures> picturesOf(const report::ReportContent& content)
{
    std::vector<report::SightPictures> pictures;
    for (const auto& [finding, facts] : content.read.findings)
        for (const report::MarkerEntry& entry : content.markers) {
            const std::string& id = entry.marker.id;
            if (std::find(finding.markers.begin(), finding.markers.end(), id) == finding.markers.end())
                continue;
            if (!entry.endoscopic_picture.empty())
                pictures.push_back(
                    {id, "Finding " + std::to_string(finding.number()) + ", marker " + id + ", " + entry.scan_label});
        }
    return pictures;
}

std::vector<report::ObjectKind> kindsOf(const Config& config)
{
    std::vector<report::ObjectKind> kinds;
    for (const std::string& name : config.get<SigningOptions>().objects)
        kinds.push_back(report::objectKindNamed(name));
    return kinds;
}

/// One that cannot be read is left out, and is no reason not to sign.
report::ReportOptions withReadableLogo(report::ReportOptions options, std::vector<std::string>& warnings)
try {
    if (!options.logo.empty())
        picture::readPng(options.logo);
    return options;
} catch (const Error&) {
    warnings.push_back("the site's logo cannot be read: " + options.logo);
    options.logo.clear();
    return options;
}

/// The objects of what is signed, for the folder and for the outbox.
VersionObjects objectsOf(CaseStore& store, const Config& config, const std::string& case_id, report::ShownScans& scans,
                         const report::ObjectContent& content, const fs::path& folder)
{
    const auto peers = config.get<SigningOptions>().send_to;
    const auto objects = report::writeReportObjects(scans, content, folder);
    VersionObjects kept;
    for (const report::ReportObject& object : objects)
        kept.files.push_back(object.file);
    kept.also = [&store, case_id, peers, objects](soci::session& sql, const ReportVersion&) {
        std::vector<OutboxObject> queued;
        for (const report::ReportObject& object : objects)
            queued.push_back({reportFolder(store, case_id) / object.file.filename(), object.sop_class, object.sop_uid});
        for (const std::string& peer : peers)
            queueObjects(store, sql, case_id, peer, queued);
    };
    return kept;
}

}  // namespace

GivenReport giveOutReport(CaseStore& store, const Config& config, const std::string& case_id, bool sign,
                          Progress& progress)
{
    const CaseRecord record = requireCase(store, case_id, IdPart::whole);
    if (sign)
        requireDeliverable(config);  // before pictures are drawn
    const std::vector<report::ObjectKind> kinds = kindsOf(config);
    requireReportable(store, record);
    const VersionDraft draft = draftVersion(store, config.get<SigningOptions>(), record.id, sign, VICON_VERSION);
    report::ReportContent content;
    content.read = readCaseFromContent(draft.content);  // what is drawn is what is signed
    content.created = draft.version.at;
    content.software_version = VICON_VERSION;
    content.version = draft.version;
    const ReportFolder folder;
    report::PackedSights packed;
    const viewer::Display display;  // one for all pictures, before there are other threads
    ReportScans scans(store, content.read, progress);
    std::optional<report::ShownScans> shown;
    report::PrintPictures printed;
    const bool pictured = sign && std::find(kinds.begin(), kinds.end(), report::ObjectKind::picture) != kinds.end();
    drawPictures(store, content, scans, printed, progress, pictured ? &packed : nullptr, [&] {
        if (sign)
            shown.emplace(store, content.read, kinds);
    });
    std::string pdf;
    std::vector<std::string> warnings;
    const report::PdfResult drawn = report::drawPdf(
        content, pdf, withReadableLogo(config.get<report::ReportOptions>(), warnings), &printed, progress);
    if (drawn.unreadable_pictures > 0)
        throw Error(ErrorCode::store,
                    "a picture of the report could not be drawn (" + drawn.warnings.front() +
                        "); "
                        "nothing was signed",
                    record.id, "see whether the disk is full, then try again");
    warnings.insert(warnings.end(), drawn.warnings.begin(), drawn.warnings.end());
    progress.check();
    VersionObjects objects;
    if (sign) {
        const ReportVersion version = versionWith(store, record.id, draft, pdf);
        objects = objectsOf(
            store, config, record.id, *shown,
            {content.read, version, amendedBy(store, record.id, version), pdf, picturesOf(content), kinds, &packed},
            folder / "");
    }
    return {keepVersion(store, record.id, draft, pdf, objects), drawn.pages, warnings};
}

}  // namespace vicon::app
