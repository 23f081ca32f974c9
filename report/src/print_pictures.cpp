#include "vicon/report/print_pictures.h"

#include <future>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "pdf_objects.h"
#include "ready_picture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::report {
namespace {

std::optional<PrintPictures::Ready> readyOf(const std::filesystem::path& png)
{
    try {
        const Picture picture = readForPrint(png, std::numeric_limits<int>::max());
        return PrintPictures::Ready{sha256OfFile(png), picture.width, picture.height, picture.channels,
                                    packed(picture)};
    } catch (const Error&) {
        return std::nullopt;  // writePdf() says what is wrong with it
    }
}

}  // namespace

struct PrintPictures::Work {
    std::mutex mutex;
    std::map<std::filesystem::path, std::shared_future<std::optional<Ready>>> pictures;
};

PrintPictures::PrintPictures() : work_(std::make_unique<Work>()) {}

PrintPictures::~PrintPictures() = default;

void PrintPictures::begin(const std::filesystem::path& png)
{
    const std::lock_guard lock(work_->mutex);
    if (!work_->pictures.contains(png))
        work_->pictures[png] = std::async(std::launch::async, readyOf, png).share();
}

const PrintPictures::Ready* PrintPictures::get(const std::filesystem::path& png) const
{
    std::shared_future<std::optional<Ready>> picture;
    {
        const std::lock_guard lock(work_->mutex);
        const auto found = work_->pictures.find(png);
        if (found == work_->pictures.end())
            return nullptr;
        picture = found->second;
    }
    const std::optional<Ready>& ready = picture.get();  // lives in the map
    return ready ? &*ready : nullptr;
}

}  // namespace vicon::report
