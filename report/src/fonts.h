#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct FT_LibraryRec_;
struct FT_FaceRec_;

namespace vicon::report {

/// The installed fonts that a report may use, and what glyphs they have.
class FontSet {
public:
    /// Looks for the known fonts in `folder` and below. Throws Error{not_found} when there is none for Latin text.
    explicit FontSet(const std::filesystem::path& folder);
    ~FontSet();
    FontSet(const FontSet&) = delete;
    FontSet& operator=(const FontSet&) = delete;

    struct Wish {
        bool bold = false;
        bool japanese = false;  ///< Han characters in their Japanese form
    };
    /// The first font, in order of preference, that has a glyph for the character; none: no font has, or the script
    /// would need shaping that is not done here.
    std::optional<int> find(char32_t c, Wish wish) const;
    bool has(int font, char32_t c) const;
    /// Width of the glyph for a font size of 1.
    double advance_em(int font, char32_t c) const;
    /// The glyphs that the character's glyph is composed of, with what those are composed of; empty: it is drawn by
    /// itself.
    std::vector<unsigned> components(int font, char32_t c) const;
    const std::filesystem::path& file(int font) const;

private:
    struct Face {
        std::filesystem::path file;
        FT_FaceRec_* face = nullptr;
    };
    int load(const std::filesystem::path& file);

    struct CloseLibrary {
        void operator()(FT_LibraryRec_* library) const;
    };
    std::unique_ptr<FT_LibraryRec_, CloseLibrary> library_;  ///< closes its faces with it
    std::vector<Face> faces_;
    std::vector<int> regular_, bold_, chinese_, japanese_;  ///< in order of preference
};

}  // namespace vicon::report
