#include "vicon/ingest/structured_report.h"

#include <algorithm>
#include <cmath>

#include "dataset.h"
#include "helper.h"
#include "structure_scan.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

namespace vicon::ingest {
namespace {

/// A centreline has some thousands of points, a report some hundreds of items.
constexpr std::size_t kMostItems = 20'000, kMostPoints = 200'000;
/// Of what could not be read; a report that says something else each time is none.
constexpr std::size_t kMostLines = 12;
constexpr int kLongestName = 64;        ///< of a concept, characters, as DICOM has it (LO)
constexpr double kLargestNumber = 1e9;  ///< whatever its unit, a larger one was not measured

/// Once a line, whatever the number of items that it is about.
void addOnce(std::vector<std::string>& lines, const std::string& line)
{
    if (lines.size() < kMostLines && std::find(lines.begin(), lines.end(), line) == lines.end())
        lines.push_back(lines.size() + 1 < kMostLines ? line : "and more");
}

CodedConcept conceptFrom(const Dataset& holder, const DcmTagKey& sequence)
{
    const auto code = holder.item(sequence);
    if (!code)
        return {};
    std::string value = code->text(DCM_CodeValue);
    for (const DcmTagKey& longer : {DCM_LongCodeValue, DCM_URNCodeValue})
        if (value.empty())
            value = code->text(longer);
    return {value, code->text(DCM_CodingSchemeDesignator), shortened(code->text(DCM_CodeMeaning), kLongestName)};
}

/// Reads the tree, as deep as structure_scan.h lets a file nest.
class TreeReader {
public:
    explicit TreeReader(std::vector<std::string>& not_read) : not_read_(not_read) {}

    ContentItem read(const Dataset& from)
    {
        ContentItem item;
        item.relation = firstOf(from.values(DCM_RelationshipType));
        item.type = firstOf(from.values(DCM_ValueType));
        item.name = conceptFrom(from, DCM_ConceptNameCodeSequence);
        readValue(from, item);
        for (const Dataset& child : from.items(DCM_ContentSequence))
            addChild(child, item);
        return item;
    }

private:
    void addChild(const Dataset& from, ContentItem& parent)
    {
        if (++items_ > kMostItems)
            throw Error(ErrorCode::bad_input,
                        "a structured report of more than " + std::to_string(kMostItems) + " items");
        if (from.has(DCM_ReferencedContentItemIdentifier)) {
            addOnce(not_read_, "references from one item to another");
            return;
        }
        parent.children.push_back(read(from));
    }

    void readValue(const Dataset& from, ContentItem& item)
    {
        if (item.type == "TEXT")
            item.text = from.longText(DCM_TextValue);
        else if (item.type == "PNAME")
            item.text = from.personName(DCM_PersonName);
        else if (item.type == "UIDREF")
            item.text = firstOf(from.values(DCM_UID));
        else if (item.type == "DATE" || item.type == "TIME" || item.type == "DATETIME")
            item.text = from.text(item.type == "DATE" ? DCM_Date : item.type == "TIME" ? DCM_Time : DCM_DateTime);
        else if (item.type == "CODE")
            item.code = conceptFrom(from, DCM_ConceptCodeSequence);
        else if (item.type == "NUM")
            readNumber(from, item);
        else if (item.type == "IMAGE" || item.type == "COMPOSITE" || item.type == "WAVEFORM")
            readReference(from, item);
        else if (item.type == "SCOORD3D")
            readPoints(from, item);
        else if (item.type != "CONTAINER")
            addOnce(not_read_, "items of type " + (item.type.empty() ? "none" : shortened(item.type, kLongestName)));
    }

    void readNumber(const Dataset& from, ContentItem& item)
    {
        const auto measured = from.item(DCM_MeasuredValueSequence);
        if (!measured)  // said to be not measurable
            return;
        item.code = conceptFrom(*measured, DCM_MeasurementUnitsCodeSequence);
        item.number = measured->number(DCM_FloatingPointValue);
        if (!item.number)
            item.number = measured->number(DCM_NumericValue);
        if (item.number && std::abs(*item.number) > kLargestNumber)
            item.number.reset();
        if (!item.number)
            addOnce(not_read_, "a number that is none: " + item.name.meaning);
    }

    static void readReference(const Dataset& from, ContentItem& item)
    {
        if (const auto to = from.item(DCM_ReferencedSOPSequence))
            item.reference = {firstOf(to->values(DCM_ReferencedSOPClassUID)),
                              firstOf(to->values(DCM_ReferencedSOPInstanceUID))};
    }

    void readPoints(const Dataset& from, ContentItem& item)
    {
        item.graphic = firstOf(from.values(DCM_GraphicType));
        item.frame_of_reference_uid = firstOf(from.values(DCM_ReferencedFrameOfReferenceUID));
        const Float32* values = nullptr;
        unsigned long count = 0;
        if (from.dcmItem().findAndGetFloat32Array(DCM_GraphicData, values, &count).bad() || !values)
            count = 0;
        constexpr unsigned long kCoordinates = 3;
        for (unsigned long n = 0; n + kCoordinates <= count; n += kCoordinates) {
            const Point3 point{values[n], values[n + 1], values[n + 2]};
            if (!std::isfinite(point.x + point.y + point.z) || ++points_ > kMostPoints) {
                addOnce(not_read_, "points that are none, or too many");
                return;
            }
            item.points_mm.push_back(point);
        }
    }

    std::vector<std::string>& not_read_;
    std::size_t items_ = 0, points_ = 0;
};

void readHeader(const Dataset& d, ContentDocument& document)
{
    document.sop_class = firstOf(d.values(DCM_SOPClassUID));
    document.sop_uid = firstOf(d.values(DCM_SOPInstanceUID));
    document.series_uid = firstOf(d.values(DCM_SeriesInstanceUID));
    document.patient = {d.text(DCM_PatientID), d.personName(DCM_PatientName), d.text(DCM_PatientBirthDate),
                        d.text(DCM_PatientSex)};
    Study& study = document.study;
    study.uid = firstOf(d.values(DCM_StudyInstanceUID));
    study.id = d.text(DCM_StudyID);
    study.date = d.text(DCM_StudyDate);
    study.time = d.text(DCM_StudyTime);
    study.description = d.text(DCM_StudyDescription);
    study.accession_number = d.text(DCM_AccessionNumber);
    study.referring_physician = d.personName(DCM_ReferringPhysicianName);
    study.institution = d.text(DCM_InstitutionName);
    const std::string model = shortened(d.text(DCM_ManufacturerModelName), kLongestName);
    document.maker = shortened(d.text(DCM_Manufacturer), kLongestName);
    if (!model.empty() && model != document.maker)
        document.maker += (document.maker.empty() ? "" : " ") + model;
    document.date = d.text(DCM_ContentDate);
    document.verified = firstOf(d.values(DCM_VerificationFlag)) == "VERIFIED";
    if (const auto observer = d.item(DCM_VerifyingObserverSequence))
        document.person = observer->personName(DCM_VerifyingObserverName);
    if (const auto author = d.item(DCM_AuthorObserverSequence); author && document.person.empty())
        document.person = author->personName(DCM_PersonName);
}

/// SOP Instance UIDs and their series, of a sequence of studies.
std::vector<std::pair<std::string, std::string>> objectsOf(const Dataset& d, const DcmTagKey& sequence)
{
    std::vector<std::pair<std::string, std::string>> objects;
    for (const Dataset& study : d.items(sequence))
        for (const Dataset& series : study.items(DCM_ReferencedSeriesSequence))
            for (const Dataset& object : series.items(DCM_ReferencedSOPSequence))
                objects.emplace_back(firstOf(object.values(DCM_ReferencedSOPInstanceUID)),
                                     firstOf(series.values(DCM_SeriesInstanceUID)));
    return objects;
}

}  // namespace

bool isMeasurementClass(const std::string& sop_class)
{
    return sop_class == UID_EnhancedSRStorage || sop_class == UID_ComprehensiveSRStorage ||
           sop_class == UID_Comprehensive3DSRStorage || sop_class == UID_ExtensibleSRStorage;
}

ContentDocument readStructuredReport(const std::filesystem::path& file)
{
    setUpDicom();
    if (const std::string why = whyNotToRead(file); !why.empty())
        throw Error(ErrorCode::bad_input, "the structured report cannot be read: " + why);
    DcmFileFormat format;
    if (const OFCondition loaded = loadFile(format, file); loaded.bad())
        throw Error(ErrorCode::bad_input,
                    std::string("the structured report is truncated or damaged (") + loaded.text() + ")");
    const Dataset d(*format.getDataset());
    ContentDocument document;
    readHeader(d, document);
    if (!isMeasurementClass(document.sop_class) || firstOf(d.values(DCM_ValueType)) != "CONTAINER")
        throw Error(ErrorCode::bad_input, "no structured report, or its tree is missing");
    if (document.sop_uid.empty() || document.study.uid.empty())
        throw Error(ErrorCode::bad_input, "a structured report that does not say which it is, or of which study");
    document.root = TreeReader(document.not_read).read(d);
    for (const auto& [uid, series] : objectsOf(d, DCM_CurrentRequestedProcedureEvidenceSequence))
        document.evidence[uid] = series;
    for (const auto& [uid, series] : objectsOf(d, DCM_PredecessorDocumentsSequence))
        document.replaces.push_back(uid);
    return document;
}

}  // namespace vicon::ingest
