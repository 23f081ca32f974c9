#include "inspect.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "dataset.h"
#include "helper.h"
#include "image_classes.h"
#include "pixel_format.h"
#include "plane_reader.h"
#include "stand_in_uid.h"
#include "structure_scan.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"
#include "vicon/ingest/structured_report.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

Inspection refused(std::string reason)
{
    return {Inspection::Verdict::refused, std::move(reason), {}};
}

/// What the first bytes of a file say, before DCMTK sees it; nothing when they say nothing.
std::optional<Inspection> inspectBeginning(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::string head(132, '\0');
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
    if (!in.is_open() || in.bad())
        return refused("cannot be read (" + std::string(std::strerror(errno)) + ")");
    if (head.empty())
        return refused("the file is empty");
    if (head.starts_with("PK\x03\x04") || head.starts_with("PK\x05\x06"))
        return Inspection{Inspection::Verdict::archive, {}, {}};
    if (head.starts_with("\x1f\x8b"))
        return refused("a gzip file, not DICOM: unpack it and import what is inside");
    return {};
}

bool hasPreamble(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::string magic(4, '\0');
    return in.seekg(128) && in.read(magic.data(), 4) && magic == "DICM";
}

void readIdentity(const Dataset& dataset, const Dataset& meta, ImageObject& object)
{
    object.sop_uid = firstOf(dataset.values(DCM_SOPInstanceUID));
    object.sop_class = firstOf(dataset.values(DCM_SOPClassUID));
    if (object.sop_uid.empty() && !(object.sop_uid = firstOf(meta.values(DCM_MediaStorageSOPInstanceUID))).empty())
        object.repairs.emplace_back("SOP Instance UID missing: taken from the file's meta header");
    if (object.sop_class.empty() && !(object.sop_class = firstOf(meta.values(DCM_MediaStorageSOPClassUID))).empty())
        object.repairs.emplace_back("SOP Class UID missing: taken from the file's meta header");
    object.study.uid = firstOf(dataset.values(DCM_StudyInstanceUID));
    object.series.uid = firstOf(dataset.values(DCM_SeriesInstanceUID));
    object.series.modality = firstOf(dataset.values(DCM_Modality));
    object.sender = meta.text(DCM_SourceApplicationEntityTitle);
}

void readPatientAndStudy(const Dataset& dataset, ImageObject& object)
{
    object.patient = {dataset.text(DCM_PatientID), dataset.personName(DCM_PatientName),
                      dataset.text(DCM_PatientBirthDate), dataset.text(DCM_PatientSex)};
    if (dataset.isCut(DCM_PatientID) || dataset.isCut(DCM_PatientName))
        object.repairs.push_back("Patient's ID or Name longer than " + std::to_string(kLongestText_bytes) +
                                 " bytes: cut");
    Study& study = object.study;
    study.id = dataset.text(DCM_StudyID);
    study.date = dataset.text(DCM_StudyDate);
    study.time = dataset.text(DCM_StudyTime);
    study.description = dataset.text(DCM_StudyDescription);
    study.accession_number = dataset.text(DCM_AccessionNumber);
    study.referring_physician = dataset.personName(DCM_ReferringPhysicianName);
    study.institution = dataset.text(DCM_InstitutionName);
}

/// The tube voltage: in the object itself, or in the functional groups of a multi-frame one.
double readKvp(const Dataset& dataset)
{
    if (const auto kvp = dataset.number(DCM_KVP))
        return *kvp;
    for (const auto& holder :
         {dataset.item(DCM_SharedFunctionalGroupsSequence), dataset.item(DCM_PerFrameFunctionalGroupsSequence)})
        if (holder)
            if (const auto details = holder->item(DCM_CTXRayDetailsSequence))
                return details->number(DCM_KVP).value_or(0);
    return 0;
}

void readSeries(const Dataset& dataset, ImageObject& object)
{
    Series& series = object.series;
    series.number = dataset.integer(DCM_SeriesNumber).value_or(0);
    series.description = dataset.text(DCM_SeriesDescription);
    series.patient_position = firstOf(dataset.values(DCM_PatientPosition));
    series.frame_of_reference_uid = firstOf(dataset.values(DCM_FrameOfReferenceUID));
    series.manufacturer = dataset.text(DCM_Manufacturer);
    series.kernel = object.slices.front().kernel;
    series.kvp = readKvp(dataset);
    series.slice_thickness_mm = object.slices.front().thickness_mm;
    series.lossy = isLossy(dataset, object.transfer_syntax);
    object.acquisition_uid = firstOf(dataset.values(DCM_AcquisitionUID));
    object.acquisition_time = dataset.text(DCM_AcquisitionDateTime);
    if (object.acquisition_time.empty() && dataset.has(DCM_AcquisitionTime))
        object.acquisition_time = dataset.text(DCM_AcquisitionDate) + dataset.text(DCM_AcquisitionTime);
}

/// Why an object is no slice of CT or MR, though it is a proper object; empty when it may be one.
std::string whySetAside(const Dataset& dataset, const ImageObject& object)
{
    const std::string& modality = object.series.modality;
    const auto said_modality = modality.empty() ? std::string() : " (" + modality + ")";
    if (!object.sop_class.empty() && !isCtClass(object.sop_class) && !isMrClass(object.sop_class))
        return std::string(dcmFindNameOfUID(object.sop_class.c_str(), "object of an unknown class")) + said_modality +
               ", no slice of CT or MR";
    const std::string expected = isMrClass(object.sop_class) ? "MR" : "CT";
    if (!modality.empty() && modality != expected && !(object.sop_class.empty() && modality == "MR"))
        return "modality " + modality + ", no slice of CT or MR";
    for (const std::string& value : dataset.values(DCM_ImageType)) {
        if (value == "LOCALIZER" || value == "SCOUT")
            return "localizer";
        if (value == "SCREEN SAVE" || value.starts_with("DOSE"))
            return "screen save or dose sheet";
    }
    if (dataset.integer(DCM_SamplesPerPixel).value_or(1) == 3)
        return "colour picture";
    return {};
}

bool looksLikeScreenSave(const Dataset& dataset)
{
    const auto type = dataset.values(DCM_ImageType);
    return dataset.has(DCM_ConversionType) || (type.size() > 1 && type[1] == "SECONDARY");
}

Inspection judge(const Dataset& dataset, const ImportOptions& options, ImageObject object)
{
    using Verdict = Inspection::Verdict;
    if (object.sop_class.empty() && object.series.modality.empty())
        return {Verdict::refused, "a DICOM object that does not say what it is (no SOP Class, no Modality)", object};
    if (isMeasurementClass(object.sop_class)) {  // what it holds is seen when it is read
        readPatientAndStudy(dataset, object);
        return {Verdict::report, {}, std::move(object)};
    }
    if (std::string why = whySetAside(dataset, object); !why.empty())
        return {Verdict::set_aside, std::move(why), object};
    if (std::string why = readPixelFormat(dataset, options, object); !why.empty())
        return {Verdict::refused, std::move(why), object};
    if (isMrClass(object.sop_class))
        object.series.modality = "MR";  // also where it is not said
    Planes planes = readPlanes(dataset, object.pixels.frames, quantityOf(object.series));
    if (planes.slices.empty() && planes.without_geometry && looksLikeScreenSave(dataset))
        return {Verdict::set_aside, "screen save or dose sheet", object};
    if (planes.slices.empty())
        return {Verdict::refused, std::move(planes.why), object};
    object.slices = std::move(planes.slices);
    object.repairs.insert(object.repairs.end(), planes.repairs.begin(), planes.repairs.end());
    readPatientAndStudy(dataset, object);
    readSeries(dataset, object);
    fillStandInUids(object);
    return {Verdict::image, {}, std::move(object)};
}

OFCondition load(const fs::path& file, const Structure& structure, DcmFileFormat& format)
{
    if (structure.fate == Structure::Fate::refused)  // for its UIDs
        return loadFile(format, file, kLargestElementInMemory, DCM_PixelData);
    const OFCondition loaded = loadFile(format, file, kLargestElementInMemory);
    return structure.trailing_bytes > 0 ? EC_Normal : loaded;
}

/// A value that breaks off with the file stays in the data set with the length that it claims, and memory is asked for
/// where it is read. Compressed pixels claim none.
void removeBrokenOff(DcmItem& item, std::uintmax_t file_bytes)
{
    std::vector<DcmObject*> broken_off;
    for (DcmObject* next = item.nextInContainer(nullptr); next; next = item.nextInContainer(next))
        if (const auto* element = dynamic_cast<DcmElement*>(next); element && !element->valueLoaded() &&
                                                                   element->getLengthField() != DCM_UndefinedLength &&
                                                                   element->getLengthField() > file_bytes)
            broken_off.push_back(next);
    for (DcmObject* element : broken_off)
        delete item.remove(element);
}

/// Reads a file whose structure a library may see.
Inspection inspectElements(const fs::path& file, const Structure& structure, const ImportOptions& options)
{
    DcmFileFormat format;
    const OFCondition loaded = load(file, structure, format);
    for (DcmItem* item : {static_cast<DcmItem*>(format.getMetaInfo()), static_cast<DcmItem*>(format.getDataset())})
        removeBrokenOff(*item, fs::file_size(file));
    ImageObject object;
    object.file = file;
    const Dataset dataset(*format.getDataset()), meta(*format.getMetaInfo());
    readIdentity(dataset, meta, object);
    if (structure.fate == Structure::Fate::refused)
        return {Inspection::Verdict::refused, structure.why, object};
    if (firstOf(meta.values(DCM_MediaStorageSOPClassUID)) == UID_MediaStorageDirectoryStorage)
        return {Inspection::Verdict::directory, {}, {}};
    if (loaded.bad() && (hasPreamble(file) || !object.sop_class.empty()))
        return {Inspection::Verdict::refused, "truncated or damaged (" + std::string(loaded.text()) + ")", object};
    if (loaded.bad() || (!hasPreamble(file) && object.sop_class.empty() && object.series.modality.empty()))
        return refused("no DICOM file, or damaged beyond reading");
    object.transfer_syntax = DcmXfer(format.getDataset()->getOriginalXfer()).getXferID();
    object.trailing_bytes = structure.trailing_bytes;
    if (structure.trailing_bytes > 0)
        object.repairs.emplace_back("bytes behind the end of its data are not used");
    return judge(dataset, options, std::move(object));
}

}  // namespace

Inspection inspectFile(const fs::path& file, const ImportOptions& options)
{
    setUpDicom();
    try {
        if (auto known = inspectBeginning(file))
            return std::move(*known);
        const Structure structure = scanStructure(file);
        if (structure.fate == Structure::Fate::refused && !structure.clear_until_pixels)
            return refused(structure.why);
        if (structure.fate == Structure::Fate::odd)
            if (std::string why = whyHarmful(file); !why.empty())
                return refused(std::move(why));
        return inspectElements(file, structure, options);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::bad_input)
            throw;
        return refused(e.what());
    } catch (const std::exception& e) {  // memory may be short for a header's claims
        return refused(std::string("its header cannot be read (") + e.what() + ")");
    }
}

}  // namespace vicon::ingest
