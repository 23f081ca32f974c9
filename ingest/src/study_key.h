#pragma once

#include <filesystem>
#include <string>

namespace vicon::ingest {

/// What a DICOM file belongs to; empty where it does not say, or is none.
struct ObjectUids {
    std::string study, series, object, sop_class;
};

/// Found without a parser, so that nothing that a peer sent can do harm.
ObjectUids uidsOf(const std::filesystem::path& file);

}  // namespace vicon::ingest
