// The plane of a cut: closes bodies that are cut open.
import {BufferAttribute, BufferGeometry, Mesh, Vector3, type Box3} from 'three';
import {makeCapMaterial, type Uniforms} from './materials';

export class Cap {
  readonly mesh: Mesh;

  constructor(uniforms: Uniforms) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(12), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.mesh = new Mesh(geometry, makeCapMaterial(uniforms));
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;  // after the counts, before what is seen
    this.mesh.visible = false;
  }

  /** Lays it through all that is drawn: where `normal` · p is `offset`. */
  set(normal: Vector3 | null, offset: number, bounds: Box3): void {
    this.mesh.visible = normal !== null && !bounds.isEmpty();
    if (!normal || bounds.isEmpty()) return;
    const middle = bounds.getCenter(new Vector3());
    middle.addScaledVector(normal, offset - normal.dot(middle));
    const size = bounds.getSize(new Vector3()).length();
    const across = (Math.abs(normal.z) > 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 0, 1)).cross(normal).normalize();
    const along = new Vector3().crossVectors(normal, across);
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) =>
      middle.clone().addScaledVector(across, a! * size).addScaledVector(along, b! * size));
    const positions = this.mesh.geometry.getAttribute('position') as BufferAttribute;
    corners.forEach((corner, i) => positions.setXYZ(i, corner.x, corner.y, corner.z));
    positions.needsUpdate = true;
  }

  dispose(): void { this.mesh.geometry.dispose(); }
}
