#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmfg/fgderimg.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include "lumen_on_planes.h"
#include "object_writing.h"
#include "shown_scans.h"
#include "vicon/core/error.h"
#include "vicon/core/uid.h"
#include "vicon/dicom/proper_values.h"
#include "vicon/scan_files/stored_volume.h"

namespace vicon::report {
namespace {

constexpr Uint16 kSegment = 1;

void require(const OFCondition& done)
{
    if (done.bad())
        throw Error(ErrorCode::internal, std::string("the segmentation cannot be written (") + done.text() + ")");
}

OFString decimal(double value)
{
    return decimalString(value).c_str();
}

/// In the order in which they lie.
std::vector<ImagePlane> sorted(std::vector<ImagePlane> planes)
{
    if (planes.empty())
        return planes;
    const ImagePlane first = planes.front();
    std::sort(planes.begin(), planes.end(), [&](const ImagePlane& a, const ImagePlane& b) {
        return first.height_mm(a.origin_mm) < first.height_mm(b.origin_mm);
    });
    return planes;
}

/// A segmentation has one matrix, direction and spacing.
bool areAlike(const std::vector<ImagePlane>& planes)
{
    constexpr double kAlike = 1e-4;
    const ImagePlane& a = planes.front();
    return a.rows > 0 && a.columns > 0 && a.row_step_mm > 0 && a.column_step_mm > 0 &&
           std::all_of(planes.begin(), planes.end(), [&](const ImagePlane& b) {
               return a.rows == b.rows && a.columns == b.columns && length(a.along_row - b.along_row) < kAlike &&
                      length(a.along_column - b.along_column) < kAlike &&
                      std::abs(a.row_step_mm - b.row_step_mm) < kAlike &&
                      std::abs(a.column_step_mm - b.column_step_mm) < kAlike;
           });
}

/// Who made the lumen, as the elements of a segmentation say it.
struct Maker {
    std::string content;    ///< at most 64 characters, as is `algorithm`
    std::string algorithm;  ///< its name
    std::string segment;    ///< in full; empty: nothing more is to be said
    std::string derivation;
};

Maker makerOf(const std::optional<LumenOrigin>& given)
{
    if (!given)
        return {"Lumen of the colon: gas and tagged fluid", "VICON", "", "segmented by VICON"};
    return {"Lumen of the colon, made by another program", kOtherAlgorithm, otherLumenWords(*given),
            "segmented by another program, put on these planes by VICON"};
}

std::unique_ptr<DcmSegmentation> emptySegmentation(const ImagePlane& plane, const Maker& maker)
{
    const IODGeneralEquipmentModule::EquipmentInfo equipment("VICON", "VICON", "1",
                                                             "1");  // writeLumen() says the version
    ContentIdentificationMacro identification;
    require(identification.setInstanceNumber("1"));
    require(identification.setContentLabel("COLON_LUMEN"));
    require(identification.setContentDescription(maker.content.c_str()));
    DcmSegmentation* made = nullptr;
    require(DcmSegmentation::createBinarySegmentation(made, Uint16(plane.rows), Uint16(plane.columns), equipment,
                                                      identification));
    return std::unique_ptr<DcmSegmentation>(made);
}

/// How another program came by its lumen is not known: it is not said to be drawn by hand, nor by none.
void addSegment(DcmSegmentation& segmentation, const Maker& maker)
{
    DcmSegment* segment = nullptr;
    require(DcmSegment::create(
        segment, "Lumen of the colon", CodeSequenceMacro("123037004", "SCT", "Anatomical Structure"),
        CodeSequenceMacro("71854001", "SCT", "Colon"), DcmSegTypes::SAT_SEMIAUTOMATIC, maker.algorithm.c_str()));
    Uint16 number = 0;
    require(segmentation.addSegment(segment, number));
}

void addGeometry(DcmSegmentation& segmentation, const std::vector<ImagePlane>& planes)
{
    const ImagePlane& a = planes.front();
    const std::unique_ptr<FGPlaneOrientationPatient> orientation(FGPlaneOrientationPatient::createMinimal(
        decimal(a.along_row.x), decimal(a.along_row.y), decimal(a.along_row.z), decimal(a.along_column.x),
        decimal(a.along_column.y), decimal(a.along_column.z)));
    require(segmentation.addForAllFrames(*orientation));
    const double step_mm = planes.size() < 2 ? 1 : (a.height_mm(planes.back().origin_mm)) / double(planes.size() - 1);
    FGPixelMeasures measures;
    require(measures.setPixelSpacing((decimal(a.row_step_mm) + "\\" + decimal(a.column_step_mm))));
    require(measures.setSliceThickness(decimal(step_mm)));
    require(measures.setSpacingBetweenSlices(decimal(step_mm)));
    require(segmentation.addForAllFrames(measures));
    const std::string organisation = uidFor("vicon lumen\n" + a.image.series_uid);
    auto& dimensions = segmentation.getDimensions();
    require(dimensions.addDimensionIndex(DCM_ReferencedSegmentNumber, organisation.c_str(),
                                         DCM_SegmentIdentificationSequence, "Segment"));
    require(dimensions.addDimensionIndex(DCM_ImagePositionPatient, organisation.c_str(), DCM_PlanePositionSequence,
                                         "Position"));
}

void addFrame(DcmSegmentation& segmentation, const ImagePlane& plane, Uint32 number, std::vector<std::uint8_t>& mask,
              const Maker& maker)
{
    FGFrameContent content;
    require(content.setFrameAcquisitionNumber(Uint16(number)));
    require(content.setDimensionIndexValues(kSegment, 0));
    require(content.setDimensionIndexValues(number, 1));
    const std::unique_ptr<FGPlanePosPatient> position(FGPlanePosPatient::createMinimal(
        decimal(plane.origin_mm.x), decimal(plane.origin_mm.y), decimal(plane.origin_mm.z)));
    OFVector<ImageSOPInstanceReferenceMacro> source(1);
    require(source.front().setReferencedSOPClassUID(plane.image.sop_class.c_str()));
    require(source.front().setReferencedSOPInstanceUID(plane.image.sop_uid.c_str()));
    const std::unique_ptr<FGDerivationImage> derivation(
        DcmSegmentation::createDerivationImageFG(source, maker.derivation.c_str()));
    OFVector<FGBase*> groups;
    groups.push_back(&content);
    groups.push_back(position.get());
    groups.push_back(derivation.get());
    require(segmentation.addFrame(mask.data(), kSegment, groups));
}

/// Returns how many planes show any of the lumen.
Uint32 addFrames(DcmSegmentation& segmentation, const std::vector<ImagePlane>& planes, const LumenOnPlanes& lumen,
                 const Maker& maker)
{
    Uint32 frames = 0;
    for (const ImagePlane& plane : planes)
        if (std::vector<std::uint8_t> mask = lumen.on(plane); !mask.empty())
            addFrame(segmentation, plane, ++frames, mask, maker);
    return frames;
}

/// Which images it was made from, by PS3.3 C.12.2; DCMTK writes them by frame alone.
void putReferences(DcmDataset& d, const std::vector<ImagePlane>& planes)
{
    DcmItem* series = nullptr;
    require(d.findOrCreateSequenceItem(DCM_ReferencedSeriesSequence, series, 0));
    put(*series, DCM_SeriesInstanceUID, planes.front().image.series_uid);
    for (const ImagePlane& plane : planes) {
        DcmItem* image = nullptr;
        constexpr signed long kAppend = -2;
        require(series->findOrCreateSequenceItem(DCM_ReferencedInstanceSequence, image, kAppend));
        put(*image, DCM_ReferencedSOPClassUID, plane.image.sop_class);
        put(*image, DCM_ReferencedSOPInstanceUID, plane.image.sop_uid);
    }
}

/// UTF-8, which the object is said to be later; DCMTK's segment takes ASCII alone.
void putMaker(DcmDataset& d, const Maker& maker)
{
    if (maker.segment.empty())
        return;
    DcmItem* segment = nullptr;
    require(d.findOrCreateSequenceItem(DCM_SegmentSequence, segment, 0));
    put(*segment, DCM_SegmentDescription, maker.segment);
}

}  // namespace

/// PS3.3 A.51.
std::unique_ptr<DcmFileFormat> drawLumen(const ScanRecord& scan, const std::vector<ImagePlane>& images,
                                         const std::filesystem::path& scan_folder,
                                         const std::optional<LumenOrigin>& given)
{
    const std::vector<ImagePlane> planes = sorted(images);
    if (planes.empty() || !areAlike(planes))
        return nullptr;
    const scan_files::StoredVolume<std::uint8_t> inside(scan_folder / "inside.mha");
    const Maker maker = makerOf(given);
    const auto segmentation = emptySegmentation(planes.front(), maker);
    addSegment(*segmentation, maker);
    addGeometry(*segmentation, planes);
    if (addFrames(*segmentation, planes, LumenOnPlanes(inside.view()), maker) == 0)
        return nullptr;
    require(segmentation->getFrameOfReference().setFrameOfReferenceUID(
        properUid(scan.series.frame_of_reference_uid).c_str()));
    require(segmentation->getStudy().setStudyInstanceUID(scan.series.uid.c_str()));  // writeLumen() says the true one
    require(segmentation->getSeries().setSeriesNumber("1"));
    segmentation->setCheckFGOnWrite(OFFalse);
    auto format = std::make_unique<DcmFileFormat>();
    require(segmentation->writeDataset(*format->getDataset()));
    putReferences(*format->getDataset(), planes);
    putMaker(*format->getDataset(), maker);
    return format;
}

/// Deflated as a whole: frames of single bits have no compression that others read.
ReportObject writeLumen(const ObjectContent& content, const std::string& scan_id, DcmFileFormat& lumen,
                        const std::filesystem::path& folder)
{
    const ObjectName name{ObjectKind::lumen, "SEG", "Lumen of the colon", scan_id};
    putCommon(*lumen.getDataset(), content, name);
    return save(lumen, content, name, folder, EXS_DeflatedLittleEndianExplicit);
}

}  // namespace vicon::report
