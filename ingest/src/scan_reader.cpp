#include "scan_reader.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "pixels.h"
#include "vicon/core/error.h"
#include "vicon/core/quantity.h"
#include "volume_writer.h"

namespace vicon::ingest {
namespace {

/// Planes that one thread decodes with one opened multi-frame object.
constexpr std::size_t kPlanesAtATime = 8;

/// Opens the object of a slice, and keeps it open while the slices come from the same one.
class OpenObject {
public:
    FrameDecoder& of(const SliceRef& ref)
    {
        if (object_ != ref.object) {
            object_ = nullptr;  // stays so when the next line throws
            decoder_ = std::make_shared<FrameDecoder>(*ref.object);
            object_ = ref.object;
        }
        return *decoder_;
    }

private:
    const ImageObject* object_ = nullptr;
    std::shared_ptr<FrameDecoder> decoder_;
};

/// Decodes the slices of a stack.
class SliceDecoder {
public:
    /// @param scale of the values, see signalScale()
    SliceDecoder(const Stack& stack, double scale) : stack_(stack), scale_(scale) {}

    std::vector<std::int16_t> densities(std::size_t slice)
    {
        try {
            return decode(slice);
        } catch (const Error& e) {
            throw Error(e.code(), e.what(), stack_.slices[slice].object->file.filename().string(),
                        "send or copy this image again, and import it");
        }
    }

private:
    std::vector<std::int16_t> decode(std::size_t slice)
    {
        const SliceRef& ref = stack_.slices[slice];
        Slice scaled = *ref.slice;
        scaled.slope *= scale_;
        scaled.intercept *= scale_;
        return open_.of(ref).densities(scaled);
    }

    const Stack& stack_;
    double scale_;
    OpenObject open_;
};

bool haveSamePixels(const SliceRef& a, const SliceRef& b, OpenObject& first, OpenObject& second)
{
    const Slice &s = *a.slice, &t = *b.slice;
    if (!(a.object->pixels == b.object->pixels) || s.slope != t.slope || s.intercept != t.intercept)
        return false;
    try {
        return first.of(a).storedPixels(s.frame) == second.of(b).storedPixels(t.frame);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::bad_input)
            throw;
        return false;
    }
}

constexpr double kHighestKept = 32767;

/// The highest value that a slice's pixels can stand for, by its header.
double highestSaid(const SliceRef& ref)
{
    const int bits = ref.object->pixels.bits_stored - (ref.object->pixels.is_signed ? 1 : 0);
    return ref.slice->slope * (std::ldexp(1, bits) - 1) + ref.slice->intercept;
}

/// The highest that they do stand for.
double highestStored(const SliceRef& ref)
{
    const std::vector<std::uint16_t> stored = FrameDecoder(*ref.object).storedPixels(ref.slice->frame);
    return ref.slice->slope * *std::max_element(stored.begin(), stored.end()) + ref.slice->intercept;
}

/// Densities are taken as they are. A signal has no unit: one that 16 bits cannot hold is halved until they can, one
/// whose steps are less than 1 is doubled as long as they can, so that rounding loses nothing.
double signalScale(const Stack& stack, Progress& progress)
{
    double highest = 0, step = 0;
    for (const SliceRef& ref : stack.slices) {
        if (quantityOf(ref.object->series) != Quantity::signal)
            return 1;
        progress.check();
        const double said = highestSaid(ref);
        highest = std::max(highest, said > kHighestKept ? highestStored(ref) : said);
        step = std::max(step, ref.slice->slope);
    }
    double scale = 1;
    while (highest * scale > kHighestKept)
        scale /= 2;
    while (step * scale < 1 && 2 * highest * scale <= kHighestKept)
        scale *= 2;
    return scale;
}

std::vector<std::int16_t> planeOf(const StackPlan& plan, const Stack& stack, const PlaneSource& source,
                                  const VolumeWriter& writer, SliceDecoder& decoder)
{
    const auto placed = [&](std::size_t slice) {
        const PixelFormat& format = stack.slices[slice].object->pixels;
        return writer.inPlane(decoder.densities(slice), format.columns, format.rows, plan.shift_pixels[slice]);
    };
    std::vector<std::int16_t> plane = placed(source.below);
    if (!source.interpolated())
        return plane;
    const std::vector<std::int16_t> above = placed(source.above);
    for (std::size_t n = 0; n < plane.size(); ++n)
        plane[n] = VolumeWriter::blend(plane[n], above[n], source.part_above);
    return plane;
}

}  // namespace

HuVolume readVolume(const Stack& stack, const StackPlan& plan, Progress& progress)
{
    VolumeWriter writer(plan);
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    const std::size_t count = plan.planes.size();
    const double scale = signalScale(stack, progress);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPlanesAtATime), [&](const auto& range) {
        SliceDecoder decoder(stack, scale);
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            writer.put(int(k), planeOf(plan, stack, plan.planes[k], writer, decoder));
            const std::lock_guard lock(telling);
            progress.check();
            progress.report(double(++done) / double(count), "decoding slices");
        }
    });
    return writer.take();
}

SamePixels comparePixels(Progress& progress)
{
    return [&progress, first = OpenObject(), second = OpenObject()](const SliceRef& a, const SliceRef& b) mutable {
        progress.check();
        return haveSamePixels(a, b, first, second);
    };
}

}  // namespace vicon::ingest
