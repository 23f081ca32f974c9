#include "compressed_frames.h"

#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <cstdint>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

[[noreturn]] void failed(const char* why)
{
    throw Error(ErrorCode::bad_input, why);
}

/// Those of the fragments from `first` on to before `last`, one behind the other. They are read to where they are
/// wanted: a copy within the data set would cost as much as reading them.
std::string bytesOf(const std::vector<DcmPixelItem*>& fragments, std::size_t first, std::size_t last)
{
    std::size_t length = 0;
    for (std::size_t n = first; n < last; ++n)
        length += fragments[n]->getLength();
    std::string out(length, '\0');
    DcmFileCache cache;
    std::size_t at = 0;
    for (std::size_t n = first; n < last; at += fragments[n++]->getLength())
        if (const Uint32 bytes = fragments[n]->getLength();
            bytes > 0 && fragments[n]->getPartialValue(out.data() + at, 0, bytes, &cache).bad())
            failed("its compressed pixels cannot be read");
    return out;
}

/// In one pass: the library counts from the first for each that is asked for by its number.
std::vector<DcmPixelItem*> fragmentsOf(DcmPixelSequence& sequence)
{
    std::vector<DcmPixelItem*> fragments;
    for (DcmObject* next = sequence.nextInContainer(nullptr); next; next = sequence.nextInContainer(next)) {
        auto* const fragment = dynamic_cast<DcmPixelItem*>(next);
        if (!fragment)
            failed("its compressed pixels cannot be read");
        fragments.push_back(fragment);
    }
    return fragments;
}

}  // namespace

CompressedFrames::CompressedFrames(DcmPixelData& pixels, const std::string& transfer_syntax, int frames)
{
    const DcmXfer xfer(transfer_syntax.c_str());
    DcmPixelSequence* sequence = nullptr;
    if (pixels.getEncapsulatedRepresentation(xfer.getXfer(), nullptr, sequence).bad() || !sequence)
        failed("its compressed pixels cannot be read");
    fragments_ = fragmentsOf(*sequence);
    if (fragments_.size() < std::size_t(frames) + 1)
        failed("its compressed pixels are cut off");
    for (std::size_t n = 1; n < fragments_.size(); ++n)
        if (fragments_[n]->getLength() == 0)
            failed("a part of its compressed pixels is empty");
    divide(frames);
}

void CompressedFrames::divide(int frames)
{
    const std::size_t end = fragments_.size();
    if (frames == 1) {
        ranges_ = {{1, end}};
    } else if (end == std::size_t(frames) + 1) {
        for (std::size_t n = 1; n < end; ++n)
            ranges_.push_back({n, n + 1});
    } else {
        divideByOffsets(std::size_t(frames));
    }
}

/// The offset table gives each frame's first byte, counted from the first fragment's item tag.
void CompressedFrames::divideByOffsets(std::size_t frames)
{
    constexpr std::uint64_t kItemHeaderBytes = 8;
    const std::string table = bytesOf(fragments_, 0, 1);
    if (table.size() != frames * 4)
        failed("its frames are split into parts, and no offset table says which part belongs to which frame");
    const auto offset = [&](std::size_t frame) {
        std::uint32_t value = 0;
        for (std::size_t n = 4; n-- > 0;)
            value = value << 8 | std::uint8_t(table[frame * 4 + n]);
        return value;
    };
    std::uint64_t at = 0;
    for (std::size_t n = 1; n < fragments_.size(); ++n) {
        if (ranges_.size() < frames && at == offset(ranges_.size())) {
            if (!ranges_.empty())
                ranges_.back().last = n;
            ranges_.push_back({n, fragments_.size()});
        }
        at += kItemHeaderBytes + fragments_[n]->getLength();
    }
    if (ranges_.size() != frames || ranges_.front().first != 1)
        failed("its offset table does not fit its compressed pixels");
}

std::string CompressedFrames::stream(int frame) const
{
    const Range& range = ranges_.at(std::size_t(frame));
    return bytesOf(fragments_, range.first, range.last);
}

}  // namespace vicon::ingest
