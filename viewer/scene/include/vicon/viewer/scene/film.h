#pragma once

#include <filesystem>
#include <memory>

#include "vicon/viewer/scene/canvas.h"

namespace vicon::viewer {

/// Pictures as a film: Ogg Theora, which any browser shows. It is written under a temporary name beside its own and has
/// its own only when finish() was called; otherwise nothing is left of it.
class Film {
public:
    /// Throws Error{store} where the file cannot be made, with the first picture.
    Film(std::filesystem::path file, int pictures_per_s);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// All of one size. Throws Error{store}, e.g. on a full disk.
    void add(const Picture& picture);
    void finish();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer
