#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>
#include <vector>

namespace vicon::ingest {

/// The compressed frames of an object, each with its fragments. Not for several threads at once.
class CompressedFrames {
public:
    /// Throws Error{bad_input} without a subject when the fragments cannot be given to the frames.
    CompressedFrames(DcmPixelData& pixels, const std::string& transfer_syntax, int frames);

    /// The stream of a frame, its fragments joined. Throws Error{bad_input}.
    std::string stream(int frame) const;

private:
    struct Range {
        std::size_t first = 0, last = 0;  ///< of the fragments, `last` behind the last
    };
    void divide(int frames);
    void divideByOffsets(std::size_t frames);

    std::vector<DcmPixelItem*> fragments_;  ///< the first is the offset table
    std::vector<Range> ranges_;
};

}  // namespace vicon::ingest
