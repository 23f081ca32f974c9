#include "measurement_report.h"

#include "object_writing.h"
#include "vicon/core/error.h"
#include "vicon/dicom/proper_values.h"

namespace vicon::report {
namespace {

constexpr auto kObserved = DSRTypes::RT_hasObsContext;
constexpr auto kMeaning = DSRTypes::RT_hasConceptMod;

void mustBeWritten(const OFCondition& done)
{
    if (done.bad())
        throw Error(ErrorCode::internal, std::string("the structured report cannot be written (") + done.text() + ")");
}

void addContext(SrTree& tree, const ObjectContent& content)
{
    tree.code(kMeaning, dcm("121049", "Language of Content Item and Descendants"), {"en", "RFC5646", "English"});
    tree.code(kObserved, dcm("121005", "Observer Type"), dcm("121006", "Person"));
    tree.person(kObserved, dcm("121008", "Person Observer Name"), content.version.person);
    tree.code(kMeaning, dcm("121058", "Procedure reported"), procedureReported(quantityOf(content.read)));
}

/// What all images of a scan have in common (TID 1602, 1604): who compares sizes years later must know it.
void describeScan(SrTree& tree, const ScanRecord& scan)
{
    constexpr auto kOfImages = DSRTypes::RT_hasAcqContext;
    tree.code(kOfImages, dcm("121139", "Modality"),
              quantityOf(scan.series) == Quantity::signal ? dcm("MR", "Magnetic Resonance")
                                                          : dcm("CT", "Computed Tomography"));
    tree.uid(kOfImages, seriesConcept(), scan.series.uid);
    if (!scan.series.patient_position.empty())
        tree.text(kOfImages, patientPositionConcept(), scan.series.patient_position);
    if (scan.series.slice_thickness_mm > 0)
        tree.number(sliceThicknessConcept(), scan.series.slice_thickness_mm, ucum("mm", "millimeter"), kOfImages);
    if (!scan.series.kernel.empty())
        tree.text(kOfImages, kernelConcept(), scan.series.kernel);
}

/// The images that show findings, a group for each scan.
void addLibrary(SrTree& tree, const ReadCase& read, const MarkerImages& images)
{
    std::map<std::string, std::vector<const SourceImage*>> by_series;
    std::set<std::string> listed;
    for (const auto& [marker, image] : images)
        if (listed.insert(image.sop_uid).second)
            by_series[image.series_uid].push_back(&image);
    tree.container(kContains, dcm("111028", "Image Library"), "1600", [&] {
        for (const auto& series : by_series)
            tree.container(kContains, dcm("126200", "Image Library Group"), nullptr, [&] {
                for (const ScanRecord& scan : read.scans)
                    if (scan.series.uid == series.first)
                        describeScan(tree, scan);
                for (const SourceImage* image : series.second)
                    tree.image(nullptr, *image);
            });
    });
}

void addWords(SrTree& tree, const Assessment& said)
{
    tree.textWhereGiven(loinc("18785-6", "Indications for Procedure"), said.indication);
    tree.textWhereGiven(dcm("121065", "Procedure Description"), said.technique);
    tree.textWhereGiven(loinc("18834-2", "Comparison study"), said.comparison);
    tree.textWhereGiven(dcm("121073", "Impression"), said.impression);
    tree.textWhereGiven(dcm("121075", "Recommendation"), said.recommendation);
}

void addParts(SrTree& tree, const ReadCase& read)
{
    for (const PartState& state : read.parts)
        tree.container(kContains, privateCode("PART", "Part of the colon in a scan"), nullptr, [&] {
            tree.code(kMeaning, findingSiteConcept(), codeOf(state.part));
            for (const ScanRecord& scan : read.scans)
                if (scan.id == state.scan_id)
                    tree.uid(kObserved, seriesConcept(), scan.series.uid);
            tree.code(kContains, privateCode("DISTENSION", "Distension"), codeOf(state.distension));
        });
}

/// Of each lumen that another program made (TID 4019): what is measured along the colon rests on it.
void addOtherLumens(SrTree& tree, const ReadCase& read)
{
    for (const ScanRecord& scan : read.scans) {
        const auto given = read.given_lumens.find(scan.id);
        if (given == read.given_lumens.end())
            continue;
        tree.container(kContains, otherLumenConcept(), nullptr, [&] {
            tree.uid(kObserved, seriesConcept(), scan.series.uid);
            tree.text(kObserved, dcm("111001", "Algorithm Name"), kOtherAlgorithm);
            tree.text(kObserved, dcm("111003", "Algorithm Version"), "not known");
            tree.text(kContains, dcm("121106", "Comment"), otherLumenWords(given->second));
        });
    }
}

void addExtracolonic(SrTree& tree, const Assessment& said)
{
    for (const ExtracolonicFinding& finding : said.extracolonic)
        tree.container(kContains, privateCode("EXTRACOLONIC_FINDING", "Extracolonic finding"), nullptr, [&] {
            tree.textWhereGiven(privateCode("ORGAN", "Organ"), finding.organ);
            tree.textWhereGiven(dcm("121071", "Finding"), finding.text);
            tree.code(kContains, extracolonicConcept(), codeOf(finding.category));
        });
}

void fillTree(DSRDocumentTree& document, const ObjectContent& content, const MarkerImages& images,
              const std::vector<Centreline>& centrelines)
{
    SrTree tree(document);
    const ReadCase& read = content.read;
    const CodedFacts study = factsOfStudy(read.assessment);
    tree.container(DSRTypes::RT_isRoot, dcm("126000", "Imaging Measurement Report"), "1500", [&] {
        addContext(tree, content);
        if (!images.empty())
            addLibrary(tree, read, images);
        tree.container(kContains, dcm("126010", "Imaging Measurements"), nullptr, [&] {
            addFindings(tree, read, images);
            addCentrelines(tree, centrelines);
            tree.numbers(study.numbers);
        });
        tree.container(kContains, {"C0034375", "UMLS", "Qualitative Evaluations"}, nullptr, [&] {
            tree.words(study);
            addParts(tree, read);
            addOtherLumens(tree, read);
            addExtracolonic(tree, read.assessment);
        });
        addWords(tree, read.assessment);
    });
}

/// The images that a document refers to, by study and series. A study whose UID is none cannot be referred to.
void addEvidence(DSRDocument& document, const ObjectContent& content, const MarkerImages& images)
{
    if (!isUid(content.read.record.study.uid))
        return;
    for (const auto& [marker, image] : images)
        mustBeWritten(document.getCurrentRequestedProcedureEvidence().addItem(
            content.read.record.study.uid.c_str(), image.series_uid.c_str(), image.sop_class.c_str(),
            image.sop_uid.c_str()));
}

bool canBeReferredTo(const Comparison& said)
{
    return isUid(said.study_uid) && isUid(said.report_series_uid) && isUid(said.report_class) && isUid(said.report_uid);
}

/// The earlier reports that findings were compared with lie in other studies.
void addPriors(DSRDocument& document, const ReadCase& read)
{
    for (const ComparedFinding& compared : read.comparisons)
        if (const Comparison& said = compared.said; said.confirmed && canBeReferredTo(said))
            mustBeWritten(
                document.getPertinentOtherEvidence().addItem(said.study_uid.c_str(), said.report_series_uid.c_str(),
                                                             said.report_class.c_str(), said.report_uid.c_str()));
}

void verify(DSRDocument& document, const ObjectContent& content)
{
    mustBeWritten(document.completeDocument("signed"));
    const DicomTime at = timeOf(content.version);
    const std::string& institution = content.read.record.study.institution;
    mustBeWritten(document.verifyDocument(properPersonName(content.version.person).c_str(),
                                          institution.empty() ? "not stated" : institution.c_str(),
                                          (at.date + at.time).c_str()));
}

void putPredecessor(DcmDataset& d, const ObjectContent& content)
{
    DcmItem *study = nullptr, *series = nullptr, *object = nullptr;
    if (d.findOrCreateSequenceItem(DCM_PredecessorDocumentsSequence, study, 0).bad() ||
        study->findOrCreateSequenceItem(DCM_ReferencedSeriesSequence, series, 0).bad() ||
        series->findOrCreateSequenceItem(DCM_ReferencedSOPSequence, object, 0).bad())
        throw Error(ErrorCode::no_memory, "the structured report cannot be written");
    put(*study, DCM_StudyInstanceUID, content.read.record.study.uid);
    put(*series, DCM_SeriesInstanceUID, seriesUid(*content.amended, ObjectKind::measurements));
    put(*object, DCM_ReferencedSOPClassUID, UID_Comprehensive3DSRStorage);
    put(*object, DCM_ReferencedSOPInstanceUID, objectUid(*content.amended, ObjectKind::measurements));
}

}  // namespace

ReportObject writeMeasurementReport(const ObjectContent& content, const MarkerImages& images,
                                    const std::vector<Centreline>& centrelines, const std::filesystem::path& folder)
{
    DSRDocument document;
    mustBeWritten(document.createNewDocument(DSRTypes::DT_Comprehensive3DSR));
    mustBeWritten(document.setSpecificCharacterSetType(DSRTypes::CS_UTF8));
    fillTree(document.getTree(), content, images, centrelines);
    addEvidence(document, content, images);
    addPriors(document, content.read);
    if (content.version.isSigned())
        verify(document, content);
    mustBeWritten(
        document.setPreliminaryFlag(content.version.isSigned() ? DSRTypes::PF_Final : DSRTypes::PF_Preliminary));
    DcmFileFormat format;
    DcmDataset& d = *format.getDataset();
    mustBeWritten(document.write(d));
    const ObjectName name{ObjectKind::measurements, "SR",
                          std::string(examinationOf(quantityOf(content.read))) + " measurements"};
    putCommon(d, content, name);
    put(d, DCM_SOPClassUID, UID_Comprehensive3DSRStorage);
    if (content.amended)
        putPredecessor(d, content);
    return save(format, content, name, folder);
}

ReportObject writeKeyImages(const ObjectContent& content, const MarkerImages& images,
                            const std::filesystem::path& folder)
{
    DSRDocument document;
    mustBeWritten(document.createNewDocument(DSRTypes::DT_KeyObjectSelectionDocument));
    mustBeWritten(document.setSpecificCharacterSetType(DSRTypes::CS_UTF8));
    SrTree tree(document.getTree());
    tree.container(DSRTypes::RT_isRoot, dcm("113000", "Of Interest"), "2010", [&] {
        tree.text(kContains, dcm("113012", "Key Object Description"), "Slices that show the findings of the report");
        std::set<std::string> listed;
        for (const auto& [marker, image] : images)
            if (listed.insert(image.sop_uid).second)
                tree.image(nullptr, image);
    });
    addEvidence(document, content, images);
    DcmFileFormat format;
    DcmDataset& d = *format.getDataset();
    mustBeWritten(document.write(d));
    const ObjectName name{ObjectKind::key_images, "KO", "Slices with findings"};
    putCommon(d, content, name);
    return save(format, content, name, folder);
}

}  // namespace vicon::report
