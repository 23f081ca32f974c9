#include "vicon/text/font_set.h"

#include <ft2build.h>
#include <hb-ft.h>
#include FT_FREETYPE_H
#include <unicode/uchar.h>

#include <algorithm>
#include <string>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::text {
namespace {

using Names = std::vector<std::string>;

// A sans with Latin, Greek and Cyrillic, then scripts of their own. DejaVu has symbols, which in Chinese fonts are as
// wide as a Han character.
const Names kScreen{"DejaVuSans.ttf", "NotoSans-Regular.ttf", "NotoSansThai-Regular.ttf", "NotoSansHebrew-Regular.ttf",
                    "NotoSansArabic-Regular.ttf"};
const Names kPaper{"NotoSans-Regular.ttf", "NotoSansHebrew-Regular.ttf", "NotoSansArabic-Regular.ttf",
                   "NotoSansThai-Regular.ttf", "DejaVuSans.ttf"};
const Names kBoldPaper{"NotoSans-Bold.ttf", "NotoSansHebrew-Bold.ttf", "NotoSansArabic-Bold.ttf",
                       "NotoSansThai-Bold.ttf", "DejaVuSans-Bold.ttf"};
const Names kChinese{"wqy-zenhei.ttc", "DroidSansFallbackFull.ttf", "ipag.ttf"};
const Names kJapanese{"ipag.ttf", "wqy-zenhei.ttc", "DroidSansFallbackFull.ttf"};

Names preferred(FontSet::Medium medium, FontStyle style)
{
    Names names = style.bold ? kBoldPaper : Names{};
    for (const Names& more :
         {medium == FontSet::Medium::screen ? kScreen : kPaper, style.japanese ? kJapanese : kChinese})
        names.insert(names.end(), more.begin(), more.end());
    return names;
}

/// The preferred ones, then each other script's upright font of the wanted weight, then the rest.
std::size_t rankOf(const fs::path& file, const Names& names, bool bold)
{
    const std::string name = file.filename().string();
    const auto at = std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
    if (at < names.size())
        return at;
    if (bold && name.ends_with("-Bold.ttf"))
        return at;
    return at + (name.ends_with("-Regular.ttf") ? 1 : 2);
}

bool isFont(const fs::path& file)
{
    const std::string extension = file.extension().string();
    return extension == ".ttf" || extension == ".ttc" || extension == ".otf";
}

std::vector<fs::path> fontFiles(const std::vector<fs::path>& folders)
{
    std::vector<fs::path> files;
    for (const fs::path& folder : folders) {
        std::error_code absent;
        for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, absent), end;
             !absent && at != end; at.increment(absent))
            if (isFont(at->path()))
                files.push_back(at->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// A private character is another sign in every font; an unassigned one is none.
bool hasMeaning(char32_t c)
{
    const auto type = u_charType(UChar32(c));
    return type != U_PRIVATE_USE_CHAR && type != U_UNASSIGNED && type != U_SURROGATE;
}

}  // namespace

void FontSet::Closer::operator()(FT_LibraryRec_* library) const
{
    FT_Done_FreeType(library);
}

void FontSet::Closer::operator()(hb_font_t* shaper) const
{
    hb_font_destroy(shaper);
}

FontSet::FontSet(const std::vector<fs::path>& folders, Medium medium) : medium_(medium)
{
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0)
        throw Error(ErrorCode::no_memory, "the font library cannot be started");
    library_.reset(library);
    for (const fs::path& file : fontFiles(folders))
        entries_.push_back({file, nullptr, false, nullptr});
}

FontSet::~FontSet() = default;

FT_Face FontSet::open(Entry& entry)
{
    if (entry.tried)
        return entry.face;
    entry.tried = true;
    if (FT_New_Face(library_.get(), entry.file.c_str(), 0, &entry.face) != 0) {
        entry.face = nullptr;
    } else if (!FT_IS_SCALABLE(entry.face) || FT_Select_Charmap(entry.face, FT_ENCODING_UNICODE) != 0) {
        FT_Done_Face(entry.face);
        entry.face = nullptr;
    }
    return entry.face;
}

FontSet::Order& FontSet::orderOf(FontStyle style)
{
    Order& order = orders_[{style.bold, style.japanese}];
    if (order.fonts.empty()) {
        const Names names = preferred(medium_, style);
        std::vector<std::pair<std::size_t, int>> ranks;
        for (std::size_t n = 0; n < entries_.size(); ++n)
            ranks.emplace_back(rankOf(entries_[n].file, names, style.bold), int(n));
        std::sort(ranks.begin(), ranks.end());
        for (const auto& [rank, font] : ranks)
            order.fonts.push_back(font);
    }
    return order;
}

std::optional<int> FontSet::find(char32_t c, FontStyle style)
{
    Order& order = orderOf(style);
    if (const auto known = order.known.find(c); known != order.known.end())
        return known->second;
    return order.known[c] = hasMeaning(c) ? findForAll({&c, 1}, style) : std::nullopt;
}

std::optional<int> FontSet::findForAll(std::u32string_view characters, FontStyle style)
{
    for (const int font : orderOf(style).fonts)
        if (FT_Face face = open(entries_[std::size_t(font)]))
            if (std::all_of(characters.begin(), characters.end(),
                            [&](char32_t c) { return FT_Get_Char_Index(face, c) != 0; }))
                return font;
    return {};
}

hb_font_t* FontSet::shaper(int font)
{
    Entry& entry = entries_[std::size_t(font)];
    if (!entry.shaper)
        entry.shaper.reset(hb_ft_font_create_referenced(entry.face));
    return entry.shaper.get();
}

}  // namespace vicon::text
