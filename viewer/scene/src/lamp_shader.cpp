#include "lamp_shader.h"

#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <string>

namespace vicon::viewer {
namespace {

// What light is left where the wall is least open. Chosen by eye: clefts and the feet of folds and polyps stand out,
// and nothing in them is too dark to read.
constexpr double kClosedLight = 0.35;

// Light fades with the distance, so that depth is seen; a wall seen flat keeps some light, as from the walls around it,
// so that the far side of a fold's edge is not a black rim. The fading is shown by its root, which is near what
// a screen makes of numbers: without it what has a tenth of the light looks black, and nothing could be read beyond a
// few centimetres.
//
// A pixel needs the cosine of the angle between the wall's normal and the way to the lamp. Cosines of the corners,
// interpolated, would flatten the shine on a near wall, whose triangles are large. So corners hand on how the normal
// leans, as a point of Lambert's azimuthal map (of equal areas) around the way to the lamp: the cosine is 1 less the
// square of the point's distance from the map's middle. That serves as well as interpolating normals, and takes no root
// and no division a pixel.
constexpr const char* kVertexShader = R"(//VTK::System::Dec
in vec4 vertexMC;
in vec3 normalMC;
ATTRIBUTES_IN
uniform mat3 normalMatrix;
uniform mat4 MCVCMatrix;
uniform mat4 MCDCMatrix;
uniform float lampReach;
out vec3 leanAndLight;
HANDED_ON
void main()
{
  vec3 normal = normalMatrix * normalMC;
  vec3 place = (MCVCMatrix * vertexMC).xyz;
  float distance2 = dot(place, place);
  vec3 toLamp = place * -inversesqrt(distance2);
  float facing = dot(normal, toLamp);
  // In a frame turned from the picture's to the line of sight by the shortest way.
  vec2 lean = normal.xy - toLamp.xy * (normal.z + dot(normal.xy, toLamp.xy) / max(1.0 + toLamp.z, 0.01));
  lean *= inversesqrt(max(1.0 + facing, 0.01));
  float light = sqrt(1.12 / (1.0 + distance2 / (lampReach * lampReach)));
  leanAndLight = vec3(lean, light * OPEN_LIGHT);
  HAND_ON
  gl_Position = MCDCMatrix * vertexMC;
}
)";

// No pixel is discarded and the picture is not read: the driver can test and write depths first.
constexpr const char* kFragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec3 leanAndLight;
TAKEN_OVER
uniform vec3 diffuseColorUniform;
void main()
{
  vec3 color = diffuseColorUniform;
  OTHER_COLOR
  float facing = max(1.0 - dot(leanAndLight.xy, leanAndLight.xy), 0.0);
  float facing2 = facing * facing, facing4 = facing2 * facing2, facing8 = facing4 * facing4;
  float facing16 = facing8 * facing8;
  float shine = 0.09 * facing16 * facing16 * facing8;
  gl_FragData[0] = vec4((color * (0.16 + 0.84 * facing) + vec3(shine)) * leanAndLight.z, 1.0);
}
)";

/// What a look adds to the two shaders.
struct Addition {
    std::string attributes, out, hand_on, in, color;
};

Addition additionOf(const LampLook& look)
{
    Addition adds;
    if (look.by_openness)
        adds.attributes += "in float openness;\n";
    if (look.colors == WallColors::depth) {  // the light says less of the distance then: the colour does
        adds.out += "out float depth;\n";
        adds.hand_on +=
            "depth = min(sqrt(distance2) / (1.6 * lampReach), 1.0); leanAndLight.z = sqrt(leanAndLight.z);\n";
        adds.in += "in float depth;\n";
        adds.color += "color = mix(vec3(1.0, 0.88, 0.68), vec3(0.16, 0.36, 0.82), depth);\n";
    }
    if (look.by_tagging) {
        adds.attributes += "in float tagging;\n";
        adds.out += "out float tagged;\n";
        adds.hand_on += "tagged = tagging;\n";
        adds.in += "in float tagged;\n";
        adds.color +=
            "color = mix(color, vec3(0.45, 0.66, 0.95), 0.45 * min(tagged, 1.0));\n"
            "color = mix(color, vec3(0.62, 0.30, 0.85), 0.7 * clamp(tagged - 1.0, 0.0, 1.0));\n";
    }
    return adds;
}

void put(std::string& code, const std::string& place, const std::string& what)
{
    code.replace(code.find(place), place.size(), what);
}

}  // namespace

void useLampShader(vtkShaderProperty* shader, double reach_mm, const LampLook& look)
{
    const Addition adds = additionOf(look);
    std::string vertices = kVertexShader, fragments = kFragmentShader;
    put(vertices, "ATTRIBUTES_IN", adds.attributes);
    put(vertices, "HANDED_ON", adds.out);
    put(vertices, "OPEN_LIGHT",
        look.by_openness ? "mix(" + std::to_string(kClosedLight) + ", 1.0, openness * openness)" : "1.0");
    put(vertices, "HAND_ON", adds.hand_on);
    put(fragments, "TAKEN_OVER", adds.in);
    put(fragments, "OTHER_COLOR", adds.color);
    shader->SetVertexShaderCode(vertices.c_str());
    shader->SetFragmentShaderCode(fragments.c_str());
    setLampReach(shader, reach_mm);
}

void setLampReach(vtkShaderProperty* shader, double reach_mm)
{
    shader->GetVertexCustomUniforms()->SetUniformf("lampReach", float(reach_mm));
}

}  // namespace vicon::viewer
