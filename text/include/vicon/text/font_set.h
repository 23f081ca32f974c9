#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

struct FT_LibraryRec_;
struct FT_FaceRec_;
struct hb_font_t;

namespace vicon::text {

struct FontStyle {
    bool bold = false;
    bool japanese = false;  ///< Han characters in their Japanese form
};

/// The installed fonts, opened only as characters ask for them. Not for several threads at once.
class FontSet {
public:
    /// On a screen DejaVu's wide letters come first, on paper Noto's.
    enum class Medium { screen, paper };

    /// Lists the fonts in these folders and below. Throws Error{no_memory}.
    FontSet(const std::vector<std::filesystem::path>& folders, Medium medium);
    ~FontSet();
    FontSet(const FontSet&) = delete;
    FontSet& operator=(const FontSet&) = delete;

    Medium medium() const { return medium_; }
    /// The first font that has a glyph for the character: the preferred ones by name, Chinese and Japanese ones, then
    /// all others by path. A private or unassigned character has none.
    std::optional<int> find(char32_t c, FontStyle style = {});
    /// The first font that has them all.
    std::optional<int> findForAll(std::u32string_view characters, FontStyle style);
    const std::filesystem::path& file(int font) const { return entries_[std::size_t(font)].file; }

    /// The font as FreeType and HarfBuzz know it, once find() has given its number.
    FT_FaceRec_* face(int font) const { return entries_[std::size_t(font)].face; }
    hb_font_t* shaper(int font);

private:
    struct Closer {
        void operator()(FT_LibraryRec_* library) const;
        void operator()(hb_font_t* shaper) const;
    };
    struct Entry {
        std::filesystem::path file;
        FT_FaceRec_* face = nullptr;  ///< closed with the library
        bool tried = false;
        std::unique_ptr<hb_font_t, Closer> shaper;
    };
    /// What one style asks for.
    struct Order {
        std::vector<int> fonts;
        std::unordered_map<char32_t, std::optional<int>> known;
    };
    FT_FaceRec_* open(Entry& entry);
    Order& orderOf(FontStyle style);

    Medium medium_;
    std::unique_ptr<FT_LibraryRec_, Closer> library_;
    std::vector<Entry> entries_;  ///< by path
    std::map<std::pair<bool, bool>, Order> orders_;
};

}  // namespace vicon::text
