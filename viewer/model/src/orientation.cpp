#include "vicon/viewer/model/orientation.h"

#include <algorithm>
#include <array>

namespace vicon::viewer {
namespace {

struct Part {
    double size = 0;
    char letter = ' ';
};

// LPS: x grows to the patient's left, y to the back, z to the head.
std::array<Part, 3> partsOf(Vector3 d)
{
    std::array<Part, 3> parts{{{std::abs(d.x), d.x > 0 ? 'L' : 'R'},
                               {std::abs(d.y), d.y > 0 ? 'P' : 'A'},
                               {std::abs(d.z), d.z > 0 ? 'H' : 'F'}}};
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.size > b.size; });
    return parts;
}

}  // namespace

char letterFor(Vector3 direction)
{
    return partsOf(direction)[0].letter;
}

std::string lettersFor(Vector3 direction)
{
    const auto parts = partsOf(direction);
    std::string letters{parts[0].letter};
    if (parts[1].size >= parts[0].size / 2)
        letters += parts[1].letter;
    return letters;
}

std::string sideName(Vector3 direction)
{
    switch (letterFor(direction)) {
        case 'L':
            return "the left";
        case 'R':
            return "the right";
        case 'A':
            return "the front";
        case 'P':
            return "the back";
        case 'H':
            return "the head";
        default:
            return "the feet";
    }
}

std::string nameOf(SlicePlane plane)
{
    switch (plane) {
        case SlicePlane::axial:
            return "axial";
        case SlicePlane::coronal:
            return "coronal";
        case SlicePlane::sagittal:
            return "sagittal";
        default:
            return "across the lumen";
    }
}

SliceAxes axesOf(SlicePlane plane)
{
    switch (plane) {
        case SlicePlane::axial:
            return {{1, 0, 0}, {0, 1, 0}};
        case SlicePlane::coronal:
            return {{1, 0, 0}, {0, 0, -1}};
        default:
            return {{0, 1, 0}, {0, 0, -1}};
    }
}

}  // namespace vicon::viewer
