#include "vicon/viewer/scene/film.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>

#include <algorithm>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::viewer {
namespace {
constexpr int kQuality = 2;  // VTK: 0 to 2, the best
}

struct Film::Parts {
    fs::path file, temporary;
    vtkNew<vtkOggTheoraWriter> writer;
    vtkNew<vtkImageData> image;
    bool begun = false, finished = false;

    [[noreturn]] void fail() const
    {
        throw Error(ErrorCode::store, "the film cannot be written", file.string(), "look whether the disk is full");
    }
};

Film::Film(fs::path file, int pictures_per_s) : parts_(std::make_unique<Parts>())
{
    parts_->temporary = file.parent_path() / (std::string(kTemporaryPrefix) + file.filename().string());
    parts_->file = std::move(file);
    parts_->writer->SetFileName(parts_->temporary.c_str());
    parts_->writer->SetRate(pictures_per_s);
    parts_->writer->SetQuality(kQuality);
    parts_->writer->SetInputData(parts_->image);
}

Film::~Film()
{
    if (parts_->finished)
        return;
    if (parts_->begun)
        parts_->writer->End();
    std::error_code none;
    fs::remove(parts_->temporary, none);
}

void Film::add(const Picture& picture)
{
    Parts& p = *parts_;
    p.image->SetDimensions(picture.width, picture.height, 1);
    p.image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* to = static_cast<std::uint8_t*>(p.image->GetScalarPointer());
    const std::ptrdiff_t row = std::ptrdiff_t(3) * picture.width;
    for (int y = 0; y < picture.height; ++y)  // VTK's rows begin at the bottom
        std::copy_n(picture.rgb.begin() + row * (picture.height - 1 - y), row, to + row * y);
    p.image->Modified();
    if (!p.begun) {
        p.writer->Start();
        p.begun = true;
    }
    p.writer->Write();
    if (p.writer->GetError())
        p.fail();
}

void Film::finish()
{
    Parts& p = *parts_;
    if (!p.begun)
        p.fail();
    p.writer->End();
    std::error_code trouble;
    fs::permissions(p.temporary, fs::perms::owner_read | fs::perms::owner_write, trouble);
    fs::rename(p.temporary, p.file, trouble);
    if (p.writer->GetError() || trouble)
        p.fail();
    p.finished = true;
}

}  // namespace vicon::viewer
