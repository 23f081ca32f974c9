#include "vicon/viewer/model/organ_words.h"

namespace vicon::viewer {

OrganWords wordsFor(const std::string& organ)
{
    if (organ == "colon")
        return {organ, "rectum", "caecum"};
    return {organ, "root", "tip"};
}

}  // namespace vicon::viewer
