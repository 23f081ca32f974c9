#include "vicon/report/print_pictures.h"

#include <future>
#include <map>
#include <mutex>

#include "pdf_objects.h"
#include "picture.h"
#include "ready_picture.h"

namespace vicon::report {
namespace {

PrintPictures::Ready readyOf(const picture::SharedPicture& picture)
{
    const auto ready = [](const Picture& from) {
        return PrintPictures::Ready{from.width, from.height, from.channels, packed(from)};
    };
    return isGrey(*picture) ? ready(inGrey(*picture)) : ready(*picture);
}

}  // namespace

struct PrintPictures::Work {
    std::mutex mutex;
    std::map<std::filesystem::path, std::shared_future<Ready>> pictures;
};

PrintPictures::PrintPictures() : work_(std::make_unique<Work>()) {}

PrintPictures::~PrintPictures() = default;

void PrintPictures::begin(const std::filesystem::path& name, picture::SharedPicture picture)
{
    const std::lock_guard lock(work_->mutex);
    if (!work_->pictures.contains(name))
        work_->pictures[name] = std::async(std::launch::async, readyOf, std::move(picture)).share();
}

const PrintPictures::Ready* PrintPictures::get(const std::filesystem::path& name) const
{
    std::shared_future<Ready> picture;
    {
        const std::lock_guard lock(work_->mutex);
        const auto found = work_->pictures.find(name);
        if (found == work_->pictures.end())
            return nullptr;
        picture = found->second;
    }
    return &picture.get();  // lives in the map
}

}  // namespace vicon::report
