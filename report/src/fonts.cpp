#include "fonts.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_ADVANCES_H
#include <unicode/uscript.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::report {
namespace {

using Names = std::vector<const char*>;

// Files by name, in order of preference; all of them TrueType outlines, which libharu can embed. DejaVu comes after
// Noto for its symbols, and before the CJK fonts, whose symbols are as wide as a Han character.
const Names kRegular = {"NotoSans-Regular.ttf", "NotoSansHebrew-Regular.ttf", "NotoSansArabic-Regular.ttf",
                        "NotoSansThai-Regular.ttf", "DejaVuSans.ttf"};
const Names kBold = {"NotoSans-Bold.ttf", "NotoSansHebrew-Bold.ttf", "NotoSansArabic-Bold.ttf", "NotoSansThai-Bold.ttf",
                     "DejaVuSans-Bold.ttf"};
const Names kChinese = {"wqy-zenhei.ttc", "ipag.ttf", "DroidSansFallbackFull.ttf"};
const Names kJapanese = {"ipag.ttf", "wqy-zenhei.ttc", "DroidSansFallbackFull.ttf"};

/// Scripts whose text is right as glyphs one beside the other, after the bidirectional algorithm and Arabic joining.
/// Others, as Devanagari, need a shaping engine; unshaped they would be misspelt.
constexpr std::array kPlainScripts = {USCRIPT_COMMON,   USCRIPT_INHERITED, USCRIPT_LATIN,    USCRIPT_GREEK,
                                      USCRIPT_CYRILLIC, USCRIPT_ARMENIAN,  USCRIPT_GEORGIAN, USCRIPT_HEBREW,
                                      USCRIPT_ARABIC,   USCRIPT_THAI,      USCRIPT_HAN,      USCRIPT_HIRAGANA,
                                      USCRIPT_KATAKANA, USCRIPT_HANGUL,    USCRIPT_BOPOMOFO};

bool isPlainScript(char32_t c)
{
    UErrorCode status = U_ZERO_ERROR;
    const UScriptCode script = uscript_getScript(UChar32(c), &status);
    return U_SUCCESS(status) && std::find(kPlainScripts.begin(), kPlainScripts.end(), script) != kPlainScripts.end();
}

void addComponents(FT_Face face, unsigned glyph, std::vector<unsigned>& out)
{
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_RECURSE) != 0 ||
        face->glyph->format != FT_GLYPH_FORMAT_COMPOSITE)
        return;
    std::vector<unsigned> parts;
    for (FT_UInt n = 0; n < face->glyph->num_subglyphs; ++n) {
        FT_Int part = 0, argument1 = 0, argument2 = 0;
        FT_UInt flags = 0;
        FT_Matrix transform;
        if (FT_Get_SubGlyph_Info(face->glyph, n, &part, &flags, &argument1, &argument2, &transform) == 0)
            parts.push_back(unsigned(part));
    }
    for (const unsigned part : parts) {  // loading them replaces the glyph that was asked
        out.push_back(part);
        addComponents(face, part, out);
    }
}

/// The known files in the folder and below, by name.
std::map<std::string, fs::path> findFiles(const fs::path& folder)
{
    std::map<std::string, fs::path> found;
    for (const Names* names : {&kRegular, &kBold, &kChinese, &kJapanese})
        for (const char* name : *names)
            found[name];
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && at != end; at.increment(error))
        if (const auto known = found.find(at->path().filename().string());
            known != found.end() && known->second.empty())
            known->second = at->path();
    return found;
}

}  // namespace

FontSet::FontSet(const fs::path& folder)
{
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0)
        throw Error(ErrorCode::no_memory, "the font library cannot be started");
    library_.reset(library);
    const std::map<std::string, fs::path> files = findFiles(folder);
    const auto loadAll = [&](const Names& names, std::vector<int>& list) {
        for (const char* name : names)
            if (const int font = load(files.at(name)); font >= 0)
                list.push_back(font);
    };
    loadAll(kRegular, regular_);
    loadAll(kBold, bold_);
    loadAll(kChinese, chinese_);
    loadAll(kJapanese, japanese_);
    if (!find(U'A', {}))
        throw Error(ErrorCode::not_found, "no font for the report is installed here", folder.string(),
                    "install the packages fonts-noto-core and fonts-dejavu-core, or set report.font_folder");
}

FontSet::~FontSet() = default;

void FontSet::CloseLibrary::operator()(FT_Library library) const
{
    FT_Done_FreeType(library);
}

int FontSet::load(const fs::path& file)
{
    for (std::size_t n = 0; n < faces_.size(); ++n)
        if (faces_[n].file == file)
            return int(n);
    FT_Face face = nullptr;
    if (file.empty() || FT_New_Face(library_.get(), file.c_str(), 0, &face) != 0)
        return -1;
    faces_.push_back({file, face});
    return int(faces_.size()) - 1;
}

std::optional<int> FontSet::find(char32_t c, Wish wish) const
{
    constexpr char32_t kLastOfBasicPlane = 0xffff;  // libharu's text is UCS-2
    if (c > kLastOfBasicPlane || !isPlainScript(c))
        return {};
    static const std::vector<int> none;
    for (const std::vector<int>* list : {wish.bold ? &bold_ : &none, &regular_, wish.japanese ? &japanese_ : &chinese_})
        for (const int font : *list)
            if (has(font, c))
                return font;
    return {};
}

bool FontSet::has(int font, char32_t c) const
{
    return FT_Get_Char_Index(faces_[std::size_t(font)].face, c) != 0;
}

double FontSet::advance_em(int font, char32_t c) const
{
    FT_Face face = faces_[std::size_t(font)].face;
    FT_Fixed advance = 0;
    if (FT_Get_Advance(face, FT_Get_Char_Index(face, c), FT_LOAD_NO_SCALE, &advance) != 0)
        return 0;
    return double(advance) / face->units_per_EM;
}

std::vector<unsigned> FontSet::components(int font, char32_t c) const
{
    FT_Face face = faces_[std::size_t(font)].face;
    std::vector<unsigned> out;
    addComponents(face, FT_Get_Char_Index(face, c), out);
    return out;
}

const fs::path& FontSet::file(int font) const
{
    return faces_[std::size_t(font)].file;
}

}  // namespace vicon::report
