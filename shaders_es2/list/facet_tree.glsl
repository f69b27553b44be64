// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Trees of the facets of dense surfaces, walked box by box; a record of the list leads into one. Stackless: each box knows
// what follows it (facet_tree_texels.hpp). For the whole light at once. Defined before: HS_Left, what casters left of the
// light, HS_Covered, what this one covers, hs_hidesAll(), and hs_treeVertex(), which adds a vertex, with its state
// HS_TreeVertices. Needs caster_lists.glsl. With highp only.
#if defined(HS_TREES) && defined(HS_CUTS)
struct HS_TreeWalk {
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin;
  HS_HIGHP vec2 afterContour;  // where what follows all of the box is
  bool lightAbove;             // all of it lies before the receiver's own facet
  bool inBox;                  // the next record is a vertex, else a box
  bool onContour, ended;
};

HS_HIGHP vec2 hs_recordsOn(HS_HIGHP vec2 at, HS_HIGHP float count) {
  HS_HIGHP float column = floor(at.x / (2.0 * u_cellTexel.z)) + count;
  HS_HIGHP float perRow = floor(0.5 / u_cellTexel.z + 0.5), rows = floor((column + 0.5) / perRow);
  return vec2((2.0 * (column - rows * perRow) + 0.5) * u_cellTexel.z, at.y + rows * u_cellTexel.w);
}

// Whether nothing in the box, relative to the receiver, hides any of the light.
bool hs_boxMisses(HS_TreeWalk walk, HS_HIGHP vec3 low, HS_HIGHP vec3 high) {
  // What lies behind the receiver's facet hides nothing of what lies before it.
  bool behind = walk.lightAbove && dot(hs_facet, 0.5 * (low + high)) + dot(abs(hs_facet), 0.5 * (high - low)) <=
                                       hs_facetRounding;
  // At each height before the receiver the light is the square up to that height from the middle.
  HS_HIGHP float reach = max(high.z, 0.0);
  return behind || high.z <= 0.0 || min(high.x, high.y) < -reach || max(low.x, low.y) > reach;
}

// Goes from a box into it, or to its contour, or past it.
void hs_passBox(inout HS_TreeWalk walk) {
  HS_COUNT(2);
  HS_HIGHP vec4 first = floor(texture2D(u_cellLists, walk.at) * 255.0 + 0.5);
  HS_HIGHP vec4 second = floor(texture2D(u_cellLists, walk.at + vec2(u_cellTexel.z, 0.0)) * 255.0 + 0.5);
  HS_HIGHP vec3 low = (first.xyz - 128.0) * hs_wideStep + walk.origin;
  HS_HIGHP vec3 high = (vec3(first.w, second.xy) - 128.0) * hs_wideStep + walk.origin;
  HS_HIGHP float isLeaf = step(127.5, second.z), kind = second.z - 128.0 * isLeaf;
  HS_HIGHP float hasContour = step(63.5, kind);
  HS_HIGHP float skip = (kind - 64.0 * hasContour) * 256.0 + second.w;
  walk.ended = skip < 0.5;
  bool misses = hs_boxMisses(walk, low, high);
  walk.onContour = !misses && hasContour > 0.5 && low.z > hs_near;
  walk.inBox = !walk.ended && !misses && (isLeaf > 0.5 || walk.onContour);
  walk.afterContour = hs_recordsOn(walk.at, skip);
  if (misses) {
    walk.at = walk.afterContour;
  } else {
    HS_HIGHP float on = 1.0 + hasContour;
    if (hasContour > 0.5 && !walk.onContour) {
      HS_COUNT(1);
      HS_HIGHP vec2 size = floor(texture2D(u_cellLists, hs_recordAfter(walk.at)).rg * 255.0 + 0.5);
      on += 256.0 * size.x + size.y;
    }
    walk.at = hs_recordsOn(walk.at, on);
  }
}

// `address`: of hs_nextVertex() where tags.tree is 1. In phases, boxes until all fragments that are drawn together have one
// to enter, then what it holds: some devices take both sides of a branch.
void hs_walkTree(HS_HIGHP vec3 address, HS_Left left, inout HS_TreeVertices vertices, inout HS_Covered covered) {
  HS_HIGHP vec3 stepOfList = hs_step;
  HS_TreeWalk walk;
  walk.at = hs_vertexAt(address.x, address.y + 256.0 * address.z);
  HS_HIGHP vec3 center = hs_beginList(walk.at);
  hs_roundFacet();
  walk.origin = hs_originFrom(center, hs_receiver, hs_away);
  walk.lightAbove = hs_facet.z > abs(hs_facet.x) + abs(hs_facet.y);
  walk.afterContour = walk.at;
  walk.inBox = walk.onContour = walk.ended = false;
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (walk.ended || hs_hidesAll(left, covered)) break;
    for (HS_HIGHP int k = 0; k < HS_LONGEST_LIST; ++k) {
      if (walk.inBox || walk.ended) break;
      hs_passBox(walk);
    }
    for (HS_HIGHP int k = 0; k < HS_LONGEST_LIST; ++k) {
      if (!walk.inBox) break;
      HS_Tags tags;
      HS_HIGHP vec3 projected = hs_nextVertex(walk.at, walk.origin, tags);
      hs_treeVertex(vertices, covered, projected, tags);
      walk.inBox = tags.ends < 0.5;
    }
    if (walk.onContour) walk.at = walk.afterContour;
  }
  hs_step = stepOfList;
  hs_wideStep = 256.0 * stepOfList;
  hs_near = 0.25 * stepOfList.z;
  hs_roundFacet();
}
#endif
