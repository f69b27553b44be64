// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Trees of the facets of dense surfaces, walked box by box; a record of the list leads into one. Stackless: each box knows
// what follows it (facet_tree_texels.hpp). For the whole light at once. Defined before: HS_Left, what casters left of the
// light, HS_Covered, what this one covers, hs_hidesAll(), and hs_addTreeEdge() and hs_addTreeChord(), which add to it.
// Needs caster_lists.glsl. With highp only.
#if defined(HS_TREES) && defined(HS_CUTS)
struct HS_TreeWalk {
  HS_HIGHP float first;   // record of the tree
  HS_HIGHP float record;  // the next one
  HS_HIGHP float contour; // the record that tells where a contour is to be walked; less than 0: none
  HS_HIGHP vec3 origin;
  bool lightAbove;        // all of it lies before the receiver's own facet
  bool inBox;             // the next record is a vertex of its facets, which stand in strips
  bool ended;
  // The last vertices, and whether they make a facet that hides. Counter-clockwise: a b c where `way` is 1, b a c where -1.
  HS_HIGHP vec3 a, b, c;
  HS_HIGHP float way;
  bool hides;
};

HS_HIGHP vec2 hs_recordAt(HS_HIGHP float record) {
  HS_HIGHP float row = floor((2.0 * record + 1.0) * u_cellTexel.z);
  return vec2(2.0 * record * u_cellTexel.z - row + 0.5 * u_cellTexel.z, (row + 0.5) * u_cellTexel.w);
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

// A vertex as (x w, y w, w) on the light's plane. `tag`: 1 where the box or contour ends, and 32 where a loop starts.
HS_HIGHP vec3 hs_treeVertex(HS_HIGHP float record, HS_HIGHP vec3 origin, out HS_HIGHP float tag) {
  HS_COUNT(2);
  HS_HIGHP vec2 at = hs_recordAt(record);
  HS_HIGHP vec4 first = texture2D(u_cellLists, at);
  HS_HIGHP vec4 second = texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0));
  HS_HIGHP vec3 high = floor(vec3(first.xz, second.x) * 255.0 + 0.5);
  HS_HIGHP vec3 value = high - 128.0 + vec3(first.yw, second.y) * (255.0 / 256.0);
  tag = floor(second.z * 255.0 + 0.5);
  return value * hs_wideStep + origin;
}

// Whether a facet that faces the receiver with its inner side hides some of the light from it: it is before it, not all
// beyond one side of the light, and not the receiver's own.
bool hs_facetHides(HS_TreeWalk walk) {
  HS_HIGHP vec4 beyond = min(min(vec4(walk.a.xy, -walk.a.xy) - walk.a.z, vec4(walk.b.xy, -walk.b.xy) - walk.b.z),
                             vec4(walk.c.xy, -walk.c.xy) - walk.c.z);
  HS_HIGHP float highest = max(max(walk.a.z, walk.b.z), walk.c.z);
  HS_HIGHP vec3 off = vec3(hs_offFacet(walk.a), hs_offFacet(walk.b), hs_offFacet(walk.c));
  return highest > hs_near && max(max(beyond.x, beyond.y), max(beyond.z, beyond.w)) <= 0.0 &&
         max(max(off.x, off.y), off.z) >= hs_facetRounding;
}

// Goes on by a record: from a box into it, or to its contour, or past it, or to the next vertex of a box's facets. Boxes and
// vertices in one loop and by one fetch: fragments that are drawn together stand at either.
void hs_passRecord(inout HS_TreeWalk walk) {
  HS_COUNT(2);
  HS_HIGHP vec2 at = hs_recordAt(walk.record);
  HS_HIGHP vec4 first = floor(texture2D(u_cellLists, at) * 255.0 + 0.5);
  HS_HIGHP vec4 second = floor(texture2D(u_cellLists, at + vec2(u_cellTexel.z, 0.0)) * 255.0 + 0.5);
  if (walk.inBox) {
    HS_HIGHP float turns = step(1.5, second.z);
    walk.a = turns > 0.5 ? walk.a : walk.b;
    walk.b = walk.c;
    walk.c = (vec3(first.xz, second.x) - 128.0 + vec3(first.yw, second.y) * (1.0 / 256.0)) * hs_wideStep + walk.origin;
    walk.inBox = second.z - 2.0 * turns < 0.5;
    walk.record += 1.0;
    walk.way = second.w - 1.0;
    walk.hides = walk.way * dot(walk.a, cross(walk.b - walk.a, walk.c - walk.a)) > 0.0 && hs_facetHides(walk);
  } else {
    HS_HIGHP vec3 low = (first.xyz - 128.0) * hs_wideStep + walk.origin;
    HS_HIGHP vec3 high = (vec3(first.w, second.xy) - 128.0) * hs_wideStep + walk.origin;
    HS_HIGHP float isLeaf = step(127.5, second.z), kind = second.z - 128.0 * isLeaf;
    HS_HIGHP float hasContour = step(63.5, kind);
    HS_HIGHP float skip = (kind - 64.0 * hasContour) * 256.0 + second.w;
    walk.ended = skip < 0.5;
    bool misses = hs_boxMisses(walk, low, high);
    bool onContour = !misses && hasContour > 0.5 && low.z > hs_near;
    walk.contour = onContour ? walk.record + 1.0 : -1.0;
    walk.inBox = !walk.ended && !misses && isLeaf > 0.5;
    walk.record += misses || onContour ? skip : 1.0 + hasContour;
  }
}

// Adds the contour that was reached, if one was. Receivers lie behind all of it.
void hs_walkContour(inout HS_TreeWalk walk, inout HS_Covered covered) {
  HS_HIGHP float record = 0.0;
  HS_HIGHP vec2 previous = vec2(0.0);
  for (HS_HIGHP int k = 0; k < HS_LONGEST_LIST; ++k) {
    if (walk.contour < 0.0) break;
    HS_HIGHP float tag;
    if (k == 0) {
      HS_COUNT(1);
      HS_HIGHP vec2 number = floor(texture2D(u_cellLists, hs_recordAt(walk.contour)).rg * 255.0 + 0.5);
      record = walk.first + 256.0 * number.x + number.y;
    }
    HS_HIGHP vec2 point = hs_onLight(hs_treeVertex(record, walk.origin, tag));
    HS_HIGHP float starts = step(31.5, tag);
    hs_addTreeEdge(covered, mix(previous, point, starts), point);
    previous = point;
    record += 1.0;
    if (tag - 32.0 * starts > 0.5) walk.contour = -1.0;
  }
}

// `address`: of hs_nextVertex() where tags.tree is 1. In phases, boxes and facets until all fragments that are drawn together
// have one that hides, then its edges: some devices take both sides of a branch, but leave a loop that nobody is in.
void hs_walkTree(HS_HIGHP vec3 address, HS_Left left, inout HS_Covered covered) {
  HS_HIGHP vec3 stepOfList = hs_step;
  HS_HIGHP vec2 at = hs_vertexAt(address.x, address.y + 256.0 * address.z);
  HS_HIGHP vec3 center = hs_beginList(at);
  hs_roundFacet();
  HS_TreeWalk walk;
  walk.origin = hs_originFrom(center, hs_receiver, hs_away);
  walk.lightAbove = hs_facet.z > abs(hs_facet.x) + abs(hs_facet.y);
  walk.first = address.x + floor(0.5 / u_cellTexel.z + 0.5) * (address.y + 256.0 * address.z);
  walk.record = walk.first + 1.0;
  walk.contour = -1.0;
  walk.inBox = walk.ended = walk.hides = false;
  walk.a = walk.b = walk.c = vec3(0.0);
  walk.way = 0.0;
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (walk.ended || hs_hidesAll(left, covered)) break;
    walk.hides = false;
    for (HS_HIGHP int k = 0; k < HS_LONGEST_LIST; ++k) {
      if (walk.hides || walk.contour > 0.0 || walk.ended) break;
      hs_passRecord(walk);
    }
    HS_HIGHP float edges = walk.hides ? 3.0 : 0.0;
    HS_HIGHP vec3 a = walk.way > 0.0 ? walk.a : walk.b, b = walk.way > 0.0 ? walk.b : walk.a, c = walk.c;
    // Of a facet that reaches through the receiver's height the near part counts, which a chord far off closes.
    HS_HIGHP vec2 gone = vec2(0.0), met = vec2(0.0);
    HS_HIGHP float cut = 0.0;
    for (HS_HIGHP int k = 0; k < HS_LONGEST_LIST; ++k) {
      if (edges < 0.5) break;
      edges -= 1.0;
      HS_HIGHP vec3 cutFrom, cutTo;
      bool seen = hs_cutEdge(a, b, 0.0, cutFrom, cutTo);
      HS_HIGHP vec2 from = hs_onLight(cutFrom), to = hs_onLight(cutTo);
      if (seen && a.z <= hs_near) met = from;
      if (seen && b.z <= hs_near) {
        gone = to;
        cut = 1.0;
      }
      hs_addTreeEdge(covered, seen ? from : to, to);
      HS_HIGHP vec3 next = c;
      c = a;
      a = b;
      b = next;
    }
    hs_addTreeChord(covered, gone, met, cut);
    hs_walkContour(walk, covered);
  }
  hs_step = stepOfList;
  hs_wideStep = 256.0 * stepOfList;
  hs_near = 0.25 * stepOfList.z;
  hs_roundFacet();
}
#endif
