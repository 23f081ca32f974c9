#include "fonts.h"

#include <hb-ft.h>

#include <algorithm>
#include <array>
#include <string>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::viewer {
namespace {

// In this order: a sans with Latin, Greek, Cyrillic, Hebrew and Arabic forms; then the CJK ones that cover most.
constexpr std::array kPreferred{"DejaVuSans.ttf",
                                "NotoSans-Regular.ttf",
                                "NotoSansThai-Regular.ttf",
                                "NotoSansHebrew-Regular.ttf",
                                "NotoSansArabic-Regular.ttf",
                                "wqy-zenhei.ttc",
                                "DroidSansFallbackFull.ttf",
                                "ipag.ttf"};
constexpr std::array kFolders{"/usr/share/fonts", "/usr/local/share/fonts"};

/// The preferred ones, then each other script's upright font of usual weight, then the rest.
std::size_t rankOf(const fs::path& file)
{
    const std::string name = file.filename().string();
    const auto at = std::find(kPreferred.begin(), kPreferred.end(), name);
    return std::size_t(at - kPreferred.begin()) + (at == kPreferred.end() && !name.ends_with("-Regular.ttf") ? 1 : 0);
}

bool isFont(const fs::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".ttf" || extension == ".ttc" || extension == ".otf";
}

std::vector<fs::path> fontFiles()
{
    std::vector<fs::path> files;
    for (const char* folder : kFolders) {
        std::error_code absent;
        for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, absent), end;
             !absent && at != end; at.increment(absent))
            if (isFont(at->path()))
                files.push_back(at->path());
    }
    std::sort(files.begin(), files.end());
    std::stable_sort(files.begin(), files.end(),
                     [](const fs::path& a, const fs::path& b) { return rankOf(a) < rankOf(b); });
    return files;
}

}  // namespace

Fonts::Fonts()
{
    if (FT_Init_FreeType(&library_) != 0)
        throw Error(ErrorCode::internal, "the font library does not start");
    for (const fs::path& file : fontFiles())
        entries_.push_back({file});
    if (entries_.empty())
        throw Error(ErrorCode::no_display, "no fonts are installed", kFolders[0],
                    "install the Debian package 'fonts-dejavu-core'");
}

Fonts::~Fonts()
{
    shapers_.clear();
    FT_Done_FreeType(library_);  // and with it the faces
}

hb_font_t* Fonts::shaperOf(FT_Face face)
{
    auto& shaper = shapers_.try_emplace(face, nullptr, hb_font_destroy).first->second;
    if (!shaper) {
        shaper.reset(hb_ft_font_create_referenced(face));
        hb_ft_font_set_load_flags(shaper.get(), FT_LOAD_NO_HINTING);
    }
    return shaper.get();
}

FT_Face Fonts::faceAt(std::size_t n)
{
    Entry& entry = entries_[n];
    if (!entry.tried) {
        entry.tried = true;
        if (FT_New_Face(library_, entry.file.c_str(), 0, &entry.face) != 0)
            entry.face = nullptr;
        else if (!FT_IS_SCALABLE(entry.face) || FT_Select_Charmap(entry.face, FT_ENCODING_UNICODE) != 0) {
            FT_Done_Face(entry.face);
            entry.face = nullptr;
        }
    }
    return entry.face;
}

Fonts::Found Fonts::find(std::uint32_t character)
{
    if (const auto known = known_.find(character); known != known_.end())
        return known->second;
    Found found;
    for (std::size_t n = 0; n < entries_.size() && !found.face; ++n)
        if (FT_Face face = faceAt(n))
            if (const FT_UInt glyph = FT_Get_Char_Index(face, character))
                found = {face, glyph};
    return known_[character] = found;
}

}  // namespace vicon::viewer
