#include "vicon/report/report_objects.h"

#include "measurement_report.h"
#include "object_writing.h"
#include "vicon/dicom/dicom_setup.h"

namespace vicon::report {
namespace {

MarkerImages imagesOfFindings(CaseStore& store, const ReadCase& read)
{
    MarkerImages images;
    for (const ScanRecord& scan : read.scans) {
        std::optional<SourceImages> of_scan;  // read only where something was found
        for (const auto& [finding, facts] : read.findings)
            for (const FindingSight& sight : facts.sights) {
                if (sight.scan_id != scan.id)
                    continue;
                if (!of_scan)
                    of_scan.emplace(store, scan);
                if (const auto image = of_scan->nearest(sight.position_mm))
                    images.emplace(sight.marker_id, *image);
            }
    }
    return images;
}

}  // namespace

std::vector<ReportObject> writeReportObjects(CaseStore& store, const ObjectContent& content,
                                             const std::filesystem::path& folder)
{
    setUpDicom();
    const MarkerImages images = imagesOfFindings(store, content.read);
    std::vector<ReportObject> objects{writeEncapsulatedPdf(content, folder),
                                      writeMeasurementReport(content, images, folder)};
    if (!images.empty())
        objects.push_back(writeKeyImages(content, images, folder));
    return objects;
}

}  // namespace vicon::report
