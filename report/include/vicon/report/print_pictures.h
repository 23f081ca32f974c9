#pragma once

#include <filesystem>
#include <memory>

namespace vicon::picture {
struct Picture;
}

namespace vicon::report {

/// Pictures on their way into a PDF: each is compressed on a thread of its own as soon as it is there, while others are
/// still drawn. They need no files. One that was not begun writePdf() reads itself.
class PrintPictures {
public:
    PrintPictures();
    /// Waits for what is under way.
    ~PrintPictures();
    PrintPictures(const PrintPictures&) = delete;
    PrintPictures& operator=(const PrintPictures&) = delete;

    /// Any thread may call it.
    /// @param name by which the report's content calls it in place of a file
    void begin(const std::filesystem::path& name, std::shared_ptr<const picture::Picture> picture);

    struct Ready;
    /// Waits for it; nothing where it was not begun. Throws what went wrong. Any thread may call it.
    const Ready* get(const std::filesystem::path& name) const;

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

}  // namespace vicon::report
