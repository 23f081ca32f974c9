#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vicon::phantom {

/// A decimal string of at most 16 characters, as DICOM's DS has them.
std::string decimal(double value);
/// Several of them, as a value of several parts.
std::string decimals(const std::vector<double>& values);

/// Fills a data set, or an item of a sequence in one; the first failure ends it with Error{internal}.
class DicomItem {
public:
    explicit DicomItem(DcmItem& item) : item_(&item) {}

    void set(const DcmTagKey& tag, const std::string& value);
    void setShort(const DcmTagKey& tag, std::uint16_t value);
    void setSigned(const DcmTagKey& tag, std::int16_t value);
    void setDouble(const DcmTagKey& tag, double value);
    void setWords(const DcmTagKey& tag, const std::vector<std::uint16_t>& values);
    void setBytes(const DcmTagKey& tag, const std::vector<std::uint8_t>& values);
    /// A new item at the end of a sequence, which is made when it is not there.
    DicomItem append(const DcmTagKey& sequence);

private:
    DcmItem* item_;
};

struct DicomFile {
    DcmFileFormat format;
};

/// A DICOM file in the making. Its data set is made before what fills it.
class DicomObject : private DicomFile, public DicomItem {
public:
    DicomObject() : DicomItem(*format.getDataset()) {}
    DicomObject(const DicomObject&) = delete;
    DicomObject& operator=(const DicomObject&) = delete;

    /// Explicit little endian. Throws Error{store}.
    void save(const std::filesystem::path& file);
};

}  // namespace vicon::phantom
