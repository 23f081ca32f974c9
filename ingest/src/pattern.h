#pragma once

#include <fnmatch.h>

#include <string>

namespace vicon::ingest {

/// Whether the whole text is as a pattern with * and ? says, in any case.
inline bool isLike(const std::string& text, const std::string& pattern)
{
    return ::fnmatch(pattern.c_str(), text.c_str(), FNM_CASEFOLD) == 0;
}

}  // namespace vicon::ingest
