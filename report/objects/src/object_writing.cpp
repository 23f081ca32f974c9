#include "object_writing.h"

#include <array>
#include <cstdio>
#include <ctime>

#include "vicon/core/error.h"
#include "vicon/core/uid.h"

namespace fs = std::filesystem;

namespace vicon::report {
namespace {

constexpr int kFirstSeriesNumber = 9901;  // behind those of scanners

std::string uidOf(const ReportVersion& version, const std::string& what)
{
    return uidFor("vicon report\n" + version.digest + "\n" + what);
}

}  // namespace

DicomTime timeOf(const ReportVersion& version)
{
    std::tm utc{}, local{};
    if (!strptime(version.at.c_str(), "%Y-%m-%dT%H:%M:%SZ", &utc))
        return {};
    const std::time_t seconds = timegm(&utc);
    localtime_r(&seconds, &local);
    std::array<char, 9> date{}, time{};
    std::strftime(date.data(), date.size(), "%Y%m%d", &local);
    std::strftime(time.data(), time.size(), "%H%M%S", &local);
    return {date.data(), time.data()};
}

std::string nameOf(ObjectKind kind)
{
    switch (kind) {
        case ObjectKind::pdf:
            return "pdf";
        case ObjectKind::measurements:
            return "sr";
        case ObjectKind::key_images:
            return "key";
        case ObjectKind::lumen:
            return "lumen";
        case ObjectKind::picture:
            return "picture";
    }
    return "object";
}

std::string objectUid(const ReportVersion& version, ObjectKind kind, const std::string& which)
{
    return uidOf(version, nameOf(kind) + (which.empty() ? "" : " " + which));
}

std::string seriesUid(const ReportVersion& version, ObjectKind kind)
{
    return uidOf(version, "series of " + nameOf(kind));
}

int seriesNumber(ObjectKind kind)
{
    return kFirstSeriesNumber + int(kind);
}

std::string decimalString(double value)
{
    constexpr int kMostDigits = 15, kMostCharacters = 16;
    std::array<char, 64> text{};
    for (int digits = kMostDigits; digits > 0; --digits)
        if (std::snprintf(text.data(), text.size(), "%.*g", digits, value) <= kMostCharacters)
            break;
    return text.data();
}

void put(DcmItem& item, const DcmTagKey& tag, const std::string& value)
{
    if (const OFCondition done = item.putAndInsertString(tag, value.c_str()); done.bad())
        throw Error(ErrorCode::bad_input,
                    std::string("an element of the report's object cannot be written (") + done.text() + ")",
                    DcmTag(tag).getTagName());
}

void putCode(DcmItem& item, const DcmTagKey& tag, const char* value, const char* scheme, const char* meaning)
{
    DcmItem* code = nullptr;
    item.findAndDeleteElement(tag);
    if (item.findOrCreateSequenceItem(tag, code, 0).bad())
        throw Error(ErrorCode::no_memory, "the report's object cannot be written");
    put(*code, DCM_CodeValue, value);
    put(*code, DCM_CodingSchemeDesignator, scheme);
    put(*code, DCM_CodeMeaning, meaning);
}

void putCommon(DcmDataset& d, const ObjectContent& content, const ObjectName& name)
{
    const CaseRecord& record = content.read.record;
    const ReportVersion& version = content.version;
    const DicomTime at = timeOf(version);
    put(d, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(d, DCM_SOPInstanceUID, objectUid(version, name.kind, name.which));
    put(d, DCM_InstanceCreationDate, at.date);
    put(d, DCM_InstanceCreationTime, at.time);
    put(d, DCM_PatientName, record.patient.name);
    put(d, DCM_PatientID, record.patient.id);
    put(d, DCM_PatientBirthDate, record.patient.birth_date);
    put(d, DCM_PatientSex, record.patient.sex);
    put(d, DCM_StudyInstanceUID, record.study.uid);
    put(d, DCM_StudyDate, record.study.date);
    put(d, DCM_StudyTime, record.study.time);
    put(d, DCM_StudyID, record.study.id);
    put(d, DCM_StudyDescription, record.study.description);
    put(d, DCM_AccessionNumber, record.study.accession_number);
    put(d, DCM_ReferringPhysicianName, record.study.referring_physician);
    put(d, DCM_Modality, name.modality);
    put(d, DCM_SeriesInstanceUID, seriesUid(version, name.kind));
    put(d, DCM_SeriesNumber, std::to_string(seriesNumber(name.kind)));
    put(d, DCM_SeriesDescription, name.series);
    put(d, DCM_SeriesDate, at.date);
    put(d, DCM_SeriesTime, at.time);
    put(d, DCM_InstanceNumber, std::to_string(name.number > 0 ? name.number : version.version));
    put(d, DCM_ContentDate, at.date);
    put(d, DCM_ContentTime, at.time);
    if (!record.study.institution.empty())
        put(d, DCM_InstitutionName, record.study.institution);
    put(d, DCM_Manufacturer, "VICON");
    put(d, DCM_ManufacturerModelName, "VICON");
    put(d, DCM_DeviceSerialNumber, "1");
    put(d, DCM_SoftwareVersions, version.software);
}

ReportObject save(DcmFileFormat& format, const ObjectContent& content, const ObjectName& name, const fs::path& folder,
                  E_TransferSyntax syntax)
{
    OFString sop_class, sop_uid;
    format.getDataset()->findAndGetOFString(DCM_SOPClassUID, sop_class);
    format.getDataset()->findAndGetOFString(DCM_SOPInstanceUID, sop_uid);
    const fs::path file = folder / ("version-" + std::to_string(content.version.version) + "-" + nameOf(name.kind) +
                                    (name.which.empty() ? "" : "-" + name.which) + ".dcm");
    // Straight there: the folder is the caller's, who flushes what he keeps.
    const OFCondition saved =
        format.saveFile(file.c_str(), syntax, EET_ExplicitLength, EGL_withoutGL, EPD_withoutPadding);
    if (saved.bad())
        throw Error(ErrorCode::store, std::string("the object cannot be written (") + saved.text() + ")",
                    file.filename().string(), "see whether the disk is full");
    return {name.kind, sop_class.c_str(), sop_uid.c_str(), file};
}

}  // namespace vicon::report
