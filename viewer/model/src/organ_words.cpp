#include "vicon/viewer/model/organ_words.h"

namespace vicon::viewer {

OrganWords wordsFor(const Organ& organ, bool has_path)
{
    if (!has_path)
        return {organ, "middle", "middle", false};
    if (organ.isColon())
        return {organ, "rectum", "caecum"};
    return {organ, "root", "tip"};
}

}  // namespace vicon::viewer
