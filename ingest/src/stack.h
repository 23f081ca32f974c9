#pragma once

#include <functional>
#include <string>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

struct SliceRef {
    const ImageObject* object = nullptr;
    const Slice* slice = nullptr;
    /// Distance of the plane from the frame's origin along the normal of the stack.
    double along_mm = 0;
};

/// Slices of one series that may make a volume: same matrix, pixel size and orientation, one image at a place.
struct Stack {
    /// What tells it from the series' other stacks; empty for the largest one.
    std::string key;
    /// In words what tells it from all of the series' other stacks: "kernel B30f". Empty for the only one.
    std::vector<std::string> told_apart;
    std::vector<SliceRef> slices;  ///< in order along the normal
    std::vector<SliceRef> copies;  ///< images that repeat one of `slices`; stored, not used
    std::vector<std::string> repairs;
    std::string refused;  ///< why it makes no volume; empty when it may
    Vector3 normal() const { return slices.front().slice->normal(); }
};

/// Whether two images hold the same stored pixels.
using SamePixels = std::function<bool(const SliceRef&, const SliceRef&)>;

/// Splits a series into stacks. The result depends on the set of objects only, not on their order. The largest stack
/// comes first.
///
/// Images of different matrix, pixel size or orientation make stacks of their own. Where several images lie at one
/// place, they are told apart by lossy encoding, patient position, image type, kernel, acquisition number and time, and
/// phase, in this order. Other positions and kernels make stacks of their own wherever their images lie; other image
/// types, acquisitions and times do where they alternate along the normal. Copies with
/// the same pixels are dropped; what then is left in one place refuses the stack.
std::vector<Stack> splitSeries(const std::vector<const ImageObject*>& objects, const SamePixels& same_pixels);

/// A length along the slice normal in words of the patient: "z = 12.5 mm" for axial slices.
std::string placeName(const Stack& stack, double along_mm);

}  // namespace vicon::ingest
