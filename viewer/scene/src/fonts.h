#pragma once

#include <ft2build.h>
#include <hb.h>
#include FT_FREETYPE_H

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

namespace vicon::viewer {

/// The installed fonts, opened only as characters ask for them. Not for several threads at once.
class Fonts {
public:
    Fonts();
    ~Fonts();
    Fonts(const Fonts&) = delete;
    Fonts& operator=(const Fonts&) = delete;

    struct Found {
        FT_Face face = nullptr;  ///< null: no font has the character
        FT_UInt glyph = 0;
    };
    /// The first font in order that has the character: the preferred ones by name, then all others by path.
    Found find(std::uint32_t character);
    /// What arranges the glyphs of one of these faces; made once.
    hb_font_t* shaperOf(FT_Face face);

private:
    FT_Face faceAt(std::size_t n);

    struct Entry {
        std::filesystem::path file;
        FT_Face face = nullptr;
        bool tried = false;
    };
    FT_Library library_ = nullptr;
    std::vector<Entry> entries_;
    std::map<std::uint32_t, Found> known_;
    std::map<FT_Face, std::unique_ptr<hb_font_t, decltype(&hb_font_destroy)>> shapers_;
};

}  // namespace vicon::viewer
