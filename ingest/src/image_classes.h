#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <array>
#include <string>

namespace vicon::ingest {

/// Storage classes of slices: one image each, frames of one object, and such objects made from slices.
inline constexpr std::array kCtClasses{UID_CTImageStorage, UID_EnhancedCTImageStorage,
                                       UID_LegacyConvertedEnhancedCTImageStorage};
inline constexpr std::array kMrClasses{UID_MRImageStorage, UID_EnhancedMRImageStorage,
                                       UID_LegacyConvertedEnhancedMRImageStorage};

inline bool isCtClass(const std::string& sop_class)
{
    return std::ranges::find(kCtClasses, sop_class) != kCtClasses.end();
}

inline bool isMrClass(const std::string& sop_class)
{
    return std::ranges::find(kMrClasses, sop_class) != kMrClasses.end();
}

}  // namespace vicon::ingest
