#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/world/world.h"
#include "trajectory/archive.h"
#include "trajectory/motion_format.h"

namespace careen {

// The world in a trajectory file, see trajectory_format.h.

template <class Archive>
void visit(Archive& archive, Visited<Archive, MassProperties> mass) {
  archive.visit(mass.mass);
  archive.visit(mass.inverseMass);
  visit(archive, mass.inertiaBody);
  visit(archive, mass.inverseInertiaBody);
}

/// What a body has since format version 7, stored after the rest.
template <class Archive>
void visitPlacement(Archive& archive, Visited<Archive, Body> body) {
  visit(archive, body.boxCenter);
  archive.visit(body.mass.turned);
  visit(archive, body.mass.bodyFromPrincipal);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyPart> part) {
  visit(archive, part.halfExtents);
  visit(archive, part.center);
  archive.visit(part.turned);
  visit(archive, part.bodyFromPart);
}

/// What a body has since format version 13.
template <class Archive>
void visitParts(Archive& archive, Visited<Archive, Body> body) {
  if constexpr (Archive::kReads) {
    std::vector<BodyPart> parts;
    visitAll(archive, parts);
    if (!parts.empty()) {
      setParts(body, std::move(parts));
    }
  } else {
    visitAll(archive, body.parts);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyIndex> body) {
  visitIndex(archive, body.value);
}

/// 0 for a wall or 1 for a body, then its index.
template <class Archive>
void visit(Archive& archive, Visited<Archive, Partner> partner) {
  auto kind = static_cast<std::uint8_t>(partner.isWall() ? 0 : 1);
  archive.visit(kind);
  int index = partner.isWall() ? static_cast<int>(partner.wall()) : partner.body();
  visitIndex(archive, index);
  if constexpr (Archive::kReads) {
    if (kind > 1) {
      archive.fail("has an unknown kind of record");
    }
    if (index < 0) {
      archive.fail("names an unknown body or wall");
    }
    partner = kind == 0 ? Partner::ofWall(static_cast<std::size_t>(index)) : Partner::ofBody(index);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Material> material) {
  archive.visit(material.restitution);
  archive.visit(material.friction);
}

template <class Archive>
void visitSurface(Archive& archive, Visited<Archive, Material> material) {
  visit(archive, material.surface.velocity);
  visit(archive, material.surface.spin);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Body> body) {
  archive.visit(body.name);
  visit(archive, body.halfExtents);
  visit(archive, body.mass);
  visit(archive, body.material);
  visit(archive, body.initial);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Wall> wall) {
  archive.visit(wall.name);
  visit(archive, wall.normal);
  archive.visit(wall.offset);
  visit(archive, wall.material);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SpringEnd> end) {
  visitOptional(archive, end.body);
  visit(archive, end.point);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Spring> spring) {
  visit(archive, spring.from);
  visit(archive, spring.to);
  archive.visit(spring.stiffness);
  archive.visit(spring.damping);
  archive.visit(spring.restLength);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Drag> drag) {
  archive.visit(drag.linear);
  archive.visit(drag.angular);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, GravityChange> change) {
  archive.visit(change.time);
  visit(archive, change.gravity);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, World> world) {
  visit(archive, world.gravity);
  visitAll(archive, world.bodies);
  visitAll(archive, world.walls);
  visitAll(archive, world.springs);
  visitOptional(archive, world.drag);
}

}  // namespace careen
