#pragma once

#include <filesystem>
#include <memory>

namespace vicon::report {

/// Pictures on their way into a PDF: each is read and compressed on a thread of its own as soon as it is there, while
/// others are still drawn. One that was not begun, or did not work, writePdf() reads itself.
class PrintPictures {
public:
    PrintPictures();
    /// Waits for what is under way.
    ~PrintPictures();
    PrintPictures(const PrintPictures&) = delete;
    PrintPictures& operator=(const PrintPictures&) = delete;

    /// The file is whole and stays as it is. Any thread may call it.
    void begin(const std::filesystem::path& png);

    struct Ready;
    /// Waits for it; nothing where it was not begun or cannot be read. Any thread may call it.
    const Ready* get(const std::filesystem::path& png) const;

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

}  // namespace vicon::report
