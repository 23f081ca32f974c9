#include "vicon/dicom/proper_values.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>

#include "vicon/core/uid.h"

namespace vicon {

bool isUid(const std::string& text)
{
    return !text.empty() && DcmUniqueIdentifier::checkStringValue(text.c_str(), "1").good();
}

std::string properUid(const std::string& text)
{
    return isUid(text) ? text : uidFor("in place of\n" + text);
}

std::string properPersonName(const std::string& name)
{
    constexpr char kLastControl = 0x1f;
    std::string proper = name;
    std::replace_if(
        proper.begin(), proper.end(),
        [](char c) { return (c >= 0 && c <= kLastControl) || c == '\\' || c == '^' || c == '='; }, ' ');
    return proper;
}

}  // namespace vicon
