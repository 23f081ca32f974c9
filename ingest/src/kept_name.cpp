#include "kept_name.h"

#include "vicon/core/file.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kDigits = 32;

}  // namespace

std::string keptNameOf(const std::string& sop_uid)
{
    return sha256(sop_uid).substr(0, kDigits);
}

std::string keptNameIn(const std::string& file_name)
{
    const bool named = file_name.size() > kDigits && file_name[kDigits] == '-' &&
                       file_name.find_first_not_of("0123456789abcdef") == kDigits;
    return named ? file_name.substr(0, kDigits) : "";
}

}  // namespace vicon::ingest
