#pragma once

#include <cstdint>

#include "element_source.h"

namespace vicon::ingest {

/// How many bytes the deflated stream from `place` on fills; counting stops beyond `most`. Nothing is kept. A stream
/// that is damaged counts as far as it goes.
std::uint64_t deflatedSize(ElementSource& source, std::uint64_t place, std::uint64_t most);

}  // namespace vicon::ingest
