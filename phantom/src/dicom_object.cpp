#include "dicom_object.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

void check(const OFCondition& condition)
{
    if (condition.bad())
        throw Error(ErrorCode::internal, std::string("cannot fill a DICOM object: ") + condition.text());
}

}  // namespace

std::string decimal(double value)
{
    if (std::abs(value) < 1e-9)
        return "0";
    std::array<char, 40> text{};
    for (int digits = 12; digits > 0; --digits)
        if (std::snprintf(text.data(), text.size(), "%.*g", digits, value) <= 16)
            break;
    return text.data();
}

std::string decimals(const std::vector<double>& values)
{
    std::string text;
    for (const double value : values)
        text += (text.empty() ? "" : "\\") + decimal(value);
    return text;
}

void DicomItem::set(const DcmTagKey& tag, const std::string& value)
{
    check(item_->putAndInsertString(tag, value.c_str()));
}

void DicomItem::setShort(const DcmTagKey& tag, std::uint16_t value)
{
    check(item_->putAndInsertUint16(tag, value));
}

void DicomItem::setSigned(const DcmTagKey& tag, std::int16_t value)
{
    auto element = std::make_unique<DcmSignedShort>(DcmTag(tag, EVR_SS));
    check(element->putSint16(value));
    check(item_->insert(element.release(), OFTrue));
}

void DicomItem::setDouble(const DcmTagKey& tag, double value)
{
    check(item_->putAndInsertFloat64(tag, value));
}

void DicomItem::setWords(const DcmTagKey& tag, const std::vector<std::uint16_t>& values)
{
    check(item_->putAndInsertUint16Array(tag, values.data(), values.size()));
}

void DicomItem::setBytes(const DcmTagKey& tag, const std::vector<std::uint8_t>& values)
{
    check(item_->putAndInsertUint8Array(tag, values.data(), values.size()));
}

DicomItem DicomItem::append(const DcmTagKey& sequence)
{
    DcmItem* item = nullptr;
    check(item_->findOrCreateSequenceItem(sequence, item, -2));
    return DicomItem(*item);
}

void DicomObject::save(const std::filesystem::path& file)
{
    if (format.saveFile(file.string().c_str(), EXS_LittleEndianExplicit).bad())
        throw Error(ErrorCode::store, "cannot write a DICOM file", file.string(), "check space and permissions");
}

}  // namespace vicon::phantom
