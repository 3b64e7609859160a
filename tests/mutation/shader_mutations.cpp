#include "mutation/subject.h"

namespace careen {
namespace {

Mutation in(const std::string& file, const std::string& name, const std::string& piece,
            const std::string& instead) {
  return {file + ": " + name, stillLife, [=](Subject& it) { it.edits.push_back({file, piece, instead}); }};
}

Mutation opposite(const std::string& file, const std::string& name, const std::string& piece,
                  const std::string& instead) {
  return {file + ": " + name + ", against the light", againstTheLight, [=](Subject& it) {
            it.edits.push_back({file, piece, instead});
          }};
}

Mutation inTheDark(const std::string& name, const std::string& piece, const std::string& instead) {
  const std::string file = "ambient.frag";
  return {file + ": " + name, stillLifeWithoutLight, [=](Subject& it) {
            it.edits.push_back({file, piece, instead});
          }};
}

}  // namespace

Mutations boxShaderMutations() {
  const char* const frag = "box.frag";
  const char* const vert = "box.vert";
  return {
      in(frag, "ivory 5 % darker", "vec3(0.86, 0.82, 0.72)", "vec3(0.817, 0.779, 0.684)"),
      in(frag, "ink lighter", "vec3(0.05, 0.05, 0.06)", "vec3(0.07, 0.07, 0.08)"),
      in(frag, "edges of marks half a pixel off", "0.5 - distance", "1.0 - distance"),
      in(frag, "marks not smooth", "max(perPixel, 1e-9), 0.0", "max(0.001 * perPixel, 1e-9), 0.0"),
      in(frag, "pips 5 % farther apart", "0.44 * unit", "0.462 * unit"),
      in(frag, "pips 5 % larger", "0.165 * unit", "0.173 * unit"),
      in(frag, "thin pips as wide as a pixel", "min(byEdge, byChord / max(far, 1e-9))", "byEdge"),
      in(frag, "edges of pips half a pixel off", "0.5 - (size - radius)", "1.0 - (size - radius)"),
      in(frag, "no middle pip", "odd ? p :", "!odd ? p :"),
      in(frag, "four pips from three", "pips > 3.5", "pips > 2.5"),
      in(frag, "no two pips", "pips > 1.5", "pips > 2.5"),
      in(frag, "six pips are four", "pips > 5.5", "pips > 6.5"),
      in(frag, "two pips, the other diagonal", "p.x + p.y < 0.0 ? -p", "p.x + p.y > 0.0 ? -p"),
      in(frag, "inset 10 % more", "0.13 * unit", "0.143 * unit"),
      in(frag, "rounding 50 % more", "0.16 * unit", "0.24 * unit"),
      in(frag, "frame 5 % lighter", "mix(0.42 * albedo", "mix(0.441 * albedo"),
      in(frag, "no frame", "mix(0.42 * albedo, albedo, covered(panel))", "albedo"),
      in(frag, "no pips", "isLight ? kInk : kIvory, pip)", "isLight ? kInk : kIvory, 0.0)"),
      in(frag, "ink for ivory", "isLight ? kInk : kIvory", "isLight ? kIvory : kInk"),
      in(frag, "ivory on pale boxes", "vec3(0.2126, 0.7152, 0.0722)) > 0.4",
         "vec3(0.2126, 0.7152, 0.0722)) > 0.8"),
      in(frag, "edges worn 20 % wider", "0.07 * unit", "0.084 * unit"),
      in(frag, "edges worn less", "normal + 0.7", "normal + 0.5"),
      in(frag, "edges not worn", "normal = normalize(normal + 0.7", "normal = normalize(normal + 0.0"),
      in(frag, "edges worn the other way", "normal + 0.7", "normal - 0.7"),
      in(frag, "edges worn on two sides only", " + worn.y * faceAlong", ""),
      in(frag, "normal's sign", "vec3 normal = faceNormal", "vec3 normal = -faceNormal"),
      in(frag, "no edges", "write(dark, bright, nearestEdge())", "write(dark, bright, 1.0)"),
      in(frag, "edges between faces on the wrong side", "vec3(-sign(onFace.x), 0.0, halfFace.x)",
         "vec3(sign(onFace.x), 0.0, halfFace.x)"),
      in(frag, "edge's slope the other way", "edgeAlpha(edge.y, edge.zw);\n  if",
         "edgeAlpha(edge.y, -edge.zw);\n  if"),
      in(vert, "marks across", "onFace = place.xy", "onFace = place.yx"),
      in(vert, "a face's sizes exchanged", "halfFace = place.zw", "halfFace = place.wz"),
      in(vert, "a face's directions exchanged", "faceAcross = across", "faceAcross = along"),
      in(vert, "a one for a six", "pips = about.x", "pips = 7.0 - about.x"),
  };
}

Mutations surfaceShaderMutations() {
  const char* const frag = "surface.frag";
  const char* const tiles = "surface_tiles.frag";
  const char* const skirted = "surface_skirted.frag";
  const char* const vert = "surface.vert";
  return {
      in(tiles, "joints 30 % wider", "kJoint = 0.02", "kJoint = 0.026"),
      in(skirted, "skirting board 5 % higher", "kSkirting = 0.22", "kSkirting = 0.231"),
      in(frag, "rim 20 % wider", "kRim = 0.05", "kRim = 0.06"),
      in(tiles, "tiles the other way round", "1.0 + surfaceLook.z", "1.0 - surfaceLook.z"),
      in(tiles, "tiles in stripes", "wave.x * wave.y", "wave.x"),
      in(tiles, "joints lighter", "0.55 * base", "0.65 * base"),
      in(tiles, "joints one way only", "(1.0 - joints.x) * (1.0 - joints.y)", "(1.0 - joints.x)"),
      in(tiles, "joints not averaged", "max(fwidth(onSurface), 1e-5);\n  vec2 from",
         "vec2(1e-3);\n  vec2 from"),
      in(skirted, "skirting board darker", "mix(1.0, 0.62, board)", "mix(1.0, 0.58, board)"),
      in(skirted, "no skirting board", "mix(1.0, 0.62, board)", "1.0"),
      in(skirted, "lip lighter", "0.4, lip", "0.6, lip"),
      in(frag, "rim lighter", "1.0 - 0.45 * rim()", "1.0 - 0.35 * rim()"),
      in(frag, "corners lighter", "1.0 - occlusion.x * edges", "1.0 - 0.83 * occlusion.x * edges"),
      in(frag, "corners' shade narrower", "exp(-1.6 *", "exp(-1.9 *"),
      in(frag, "no shade of corners", "albedo *= openness();", ""),
      in(frag, "one corner less", "shade.x * shade.y * shade.z", "shade.y * shade.z"),
      in(frag, "no rim", "albedo *= 1.0 - 0.45 * rim()", "albedo *= 1.0"),
      in(tiles, "as rough as walls", "surfaceLook.x;", "surfaceLook.y;"),
      in(frag, "normal's sign", "roughnessHere(), surfaceNormal", "roughnessHere(), -surfaceNormal"),
      in(frag, "surfaces not occluded", "ambient(albedo, surfaceNormal) * opennessHere()",
         "ambient(albedo, surfaceNormal)"),
      in(frag, "edge's direction", "vec2(dFdx(linear), dFdy(linear))", "vec2(-dFdx(linear), -dFdy(linear))"),
      in(vert, "pattern 5 cm aside", "onSurface = place.xy", "onSurface = place.xy + 0.05"),
      in(vert, "neighbours in another order", "edges = adjoins", "edges = adjoins.yzwx"),
      in(vert, "normal upward", "surfaceNormal = normal", "surfaceNormal = up.xyz"),
      in("background.glsl", "upside down", "mix(backgroundBottom.rgb, backgroundTop.rgb",
         "mix(backgroundTop.rgb, backgroundBottom.rgb"),
      in("background.glsl", "not smooth", "smoothstep(0.0, 1.0, height)", "height"),
      in("background.vert", "higher", "+ 0.5;", "+ 0.55;"),
  };
}

Mutations lightShaderMutations() {
  const char* const light = "light.frag";
  const char* const finish = "finish.frag";
  const char* const shadow = "shadow.frag";
  return {
      inTheDark("normal's sign", "0.5 * dot", "-0.5 * dot"),
      inTheDark("from above alone", "mix(ground.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz))", "sky.rgb"),
      inTheDark("2 % darker", "return albedo", "return 0.98 * albedo"),
      in(light, "normal's sign", "dot(normal, towardsLight.xyz)", "dot(-normal, towardsLight.xyz)"),
      in(light, "sky below", "0.5 + 0.5 * dot(normal, up", "0.5 - 0.5 * dot(normal, up"),
      in(light, "nothing from around", "return albedo * mix(ground", "return 0.0 * albedo * mix(ground"),
      in(light, "no gloss", "(albedo + gloss)", "albedo"),
      in(light, "gloss alone", "(albedo + gloss)", "gloss"),
      in(light, "all sides lit alike", "(albedo + gloss) * facing", "(albedo + gloss)"),
      in(light, "light without colour", "lightColor.rgb", "vec3(dot(lightColor.rgb, vec3(0.3333)))"),
      opposite(light, "Fresnel's 0.04 is 0.06", "0.04 + 0.96", "0.06 + 0.94"),
      opposite(light, "no Fresnel", "0.04 + 0.96 * pow(1.0 - max(dot(toEye, between), 0.0), 5.0)", "0.04"),
      opposite(light, "Fresnel's power 4", "5.0)", "4.0)"),
      in(light, "roughness not to the fourth", "roughness * roughness * roughness * roughness;",
         "roughness * roughness;"),
      opposite(light, "Smith's half forgotten", "0.5 * roughness * roughness;", "roughness * roughness;"),
      in(light, "a fourth is a half", "0.25 /", "0.5 /"),
      in(light, "half way to the wrong side", "toEye + towardsLight", "toEye - towardsLight"),
      in(light, "the eye's direction's sign", "normalize(-offset)", "normalize(offset)"),
      in(finish, "gamma forgotten", "dithered(toned(color))", "dithered(toned(pow(color, vec3(2.2))))"),
      in(finish, "gamma twice", "dithered(toned(color))", "dithered(toned(pow(color, vec3(1.0 / 2.2))))"),
      in(finish, "2 % darker", "dithered(toned(color))", "dithered(toned(0.98 * color))"),
      in(finish, "red and blue exchanged", "dithered(toned(color))", "dithered(toned(color.bgr))"),
      in(finish, "shoulder from black", "float start = finish.x", "float start = 0.0"),
      in(finish, "dither ten times as strong", "finish.z * (threshold", "10.0 * finish.z * (threshold"),
      in(finish, "edges' directions exchanged", "along > 0.0 ? 1.0", "along < 0.0 ? 1.0"),
      in(finish, "edges' axes exchanged", "steep.x > steep.y", "steep.x < steep.y"),
      in(finish, "edges half as wide", "at < kReach", "at < 0.5"),
      in(shadow, "blurred twice as wide", "towardsLight.w * max", "2.0 * towardsLight.w * max"),
      in(shadow, "sharp", "towardsLight.w * max", "0.0 * max"),
      in(shadow, "lighter by a ninth", "weight * inside.x", "0.89 * weight * inside.x"),
      in(shadow, "one slab less", "inside.x * inside.y * inside.z", "inside.y * inside.z"),
      in(shadow, "of boxes behind", "last > 0.0", "first < 0.0"),
      in("shadow.vert", "5 % smaller", "halfSlab = slabs", "halfSlab = 0.95 * slabs"),
      in("write_shaded.frag", "nowhere", "shaded = finished(dark, alpha)",
         "shaded = finished(bright, alpha)"),
      in("occlusion.frag", "half as strong", "1.0 - covered * (1.0", "1.0 - 0.5 * covered * (1.0"),
      in("occlusion.frag", "of the other side", "covered = max(covered", "covered = max(0.5 - covered"),
      in("far_occlusion.frag", "nothing", "covered *= smoothstep", "covered *= 0.0 * smoothstep"),
      in("form_factor.glsl", "a corner of silhouettes elsewhere", "vec3(far.x, near.y, near.z)",
         "vec3(near.x, near.y, near.z)"),
      in("open_map.frag", "aside", "occlusion.zw * gl_FragCoord.xy",
         "occlusion.zw * (gl_FragCoord.xy + 20.0)"),
  };
}

}  // namespace careen
