#include "vicon/report/report_objects.h"

#include <algorithm>
#include <future>

#include "measurement_report.h"
#include "object_writing.h"
#include "shown_scans.h"
#include "vicon/core/error.h"

namespace vicon::report {
namespace {

std::vector<ReportObject> writeSights(const ObjectContent& content, const MarkerImages& images,
                                      const std::filesystem::path& folder)
{
    std::vector<ReportObject> objects;
    for (const SightPictures& pictures : content.pictures) {
        const auto source = images.find(pictures.marker_id);
        objects.push_back(writePictures(content, pictures, int(objects.size()) + 1,
                                        source == images.end() ? nullptr : &source->second, folder));
    }
    return objects;
}

std::vector<ReportObject> writeLumens(const ObjectContent& content, const ShownScans::Parts& shown,
                                      const std::filesystem::path& folder)
{
    std::vector<ReportObject> objects;
    for (const auto& [scan_id, lumen] : shown.lumens)
        objects.push_back(writeLumen(content, scan_id, *lumen, folder));
    return objects;
}

}  // namespace

ObjectKind objectKindNamed(const std::string& name)
{
    for (const ObjectKind kind : kAllObjects)
        if (nameOf(kind) == name)
            return kind;
    throw Error(ErrorCode::wrong_use, "a kind of object must be pdf, sr, key, lumen or picture", "'" + name + "'",
                "see 'report.objects' in the configuration");
}

std::vector<ReportObject> writeReportObjects(ShownScans& scans, const ObjectContent& content,
                                             const std::filesystem::path& folder)
{
    const ShownScans::Parts& shown = scans.parts();
    const auto wanted = [&](ObjectKind kind) {
        return std::find(content.kinds.begin(), content.kinds.end(), kind) != content.kinds.end();
    };
    using Objects = std::vector<ReportObject>;
    auto pictures = std::async(std::launch::async, [&] {
        return wanted(ObjectKind::picture) ? writeSights(content, shown.findings, folder) : Objects{};
    });
    auto lumens = std::async(std::launch::async, [&] {
        return wanted(ObjectKind::lumen) ? writeLumens(content, shown, folder) : Objects{};
    });
    Objects objects;
    if (wanted(ObjectKind::pdf))
        objects.push_back(writeEncapsulatedPdf(content, folder));
    if (wanted(ObjectKind::measurements))
        objects.push_back(writeMeasurementReport(content, shown.findings, shown.centrelines, folder));
    if (wanted(ObjectKind::key_images) && !shown.findings.empty())
        objects.push_back(writeKeyImages(content, shown.findings, folder));
    for (auto* more : {&lumens, &pictures}) {
        const Objects made = more->get();
        objects.insert(objects.end(), made.begin(), made.end());
    }
    return objects;
}

}  // namespace vicon::report
