// Draws a scene as the server describes it, and tells where in it a pointer is.
// It knows no world: points move, shapes hang on them. It draws only when something has changed.

import * as three from "three";
import { COLOURS } from "./palette";

export type Place = [number, number, number];

interface Shape {
  shape: string;
  points?: number[];
  places?: Place[];
  radius: number;
  height?: number;
  colour: string;
}

export interface SceneFacts {
  view:
    | { kind: "perspective"; position: Place; target: Place }
    | { kind: "flat"; centre: [number, number]; size: [number, number] };
  points: string[];
  handle: number;
  tempo: number;
  near?: { centre: [number, number]; size: [number, number] };
  ends?: string;
  planes: string[];
  still: Shape[];
  moving: Shape[];
}

const UP = new three.Vector3(0, 1, 0);
const GRASP = 44; // pixels around the handle in which it is grasped

/** Things that move with the points: the arm itself, or the ghost of another. */
class Figure {
  readonly group = new three.Group();
  private readonly parts: { mesh: three.Mesh; shape: Shape; at: number }[] = [];

  constructor(shapes: Shape[], ghost: boolean) {
    for (const shape of shapes) {
      const material = new three.MeshLambertMaterial({
        color: ghost ? COLOURS.ghost : (COLOURS[shape.colour] ?? COLOURS.dark),
        transparent: ghost,
        opacity: ghost ? 0.55 : 1,
        depthWrite: !ghost,
      });
      const add = (geometry: three.BufferGeometry, at: number) => {
        const mesh = new three.Mesh(geometry, material);
        this.parts.push({ mesh, shape, at });
        this.group.add(mesh);
      };
      const radius = shape.radius * (ghost ? 1.08 : 1);
      const points = shape.points ?? [];
      if (shape.shape === "tube") {
        const rod = new three.CylinderGeometry(radius, radius, 1, 14);
        const knee = new three.SphereGeometry(radius * 1.18, 14, 10);
        points.slice(1).forEach((_, i) => add(rod, i));
        points.forEach((_, i) => add(knee, -1 - i));
      } else if (shape.shape === "disc") {
        const disc = new three.CylinderGeometry(radius, radius, shape.height ?? 0.05, 40);
        disc.rotateX(Math.PI / 2);
        add(disc, -1);
      } else add(new three.SphereGeometry(radius, 24, 16), -1);
    }
    this.group.visible = false;
  }

  place(points: number[][]): void {
    const from = new three.Vector3();
    const to = new three.Vector3();
    for (const { mesh, shape, at } of this.parts) {
      const chain = shape.points ?? [];
      if (at < 0) {
        mesh.position.fromArray(points[chain[-1 - at]]);
        continue;
      }
      from.fromArray(points[chain[at]]);
      to.fromArray(points[chain[at + 1]]);
      mesh.position.copy(from).add(to).multiplyScalar(0.5);
      const along = to.sub(from);
      const length = along.length();
      mesh.scale.set(1, Math.max(length, 1e-6), 1);
      if (length > 1e-9) mesh.quaternion.setFromUnitVectors(UP, along.divideScalar(length));
    }
    this.group.visible = true;
  }
}

export class Stage {
  private readonly renderer: three.WebGLRenderer;
  private readonly world = new three.Scene();
  private readonly goals = new three.Group();
  private camera: three.PerspectiveCamera | three.OrthographicCamera =
    new three.PerspectiveCamera();
  private facts: SceneFacts | null = null;
  private body: Figure | null = null;
  private ghost: Figure | null = null;
  private points: number[][] = [];
  private dirty = false;
  private near = false;
  private orbit = { turn: 0, tilt: 0.5, far: 2, target: new three.Vector3() };
  private readonly water: three.Mesh[] = [];

  /** Draws done so far, for whoever wants to know that nothing is drawn in vain. */
  drawn = 0;

  constructor(private readonly box: HTMLElement) {
    const plain = navigator.webdriver === true;
    this.renderer = new three.WebGLRenderer({ antialias: !plain, alpha: true });
    this.renderer.setPixelRatio(plain ? 1 : Math.min(window.devicePixelRatio || 1, 2));
    box.append(this.renderer.domElement);
    this.world.add(this.goals, new three.HemisphereLight(0xffffff, 0xb9c4cf, 2.6));
    const sun = new three.DirectionalLight(0xffffff, 1.6);
    sun.position.set(1.5, -2, 4);
    this.world.add(sun);
    new ResizeObserver(() => this.resize()).observe(box);
  }

  show(facts: SceneFacts): void {
    if (this.facts) return;
    this.facts = facts;
    for (const shape of facts.still) this.world.add(this.fixed(shape));
    this.body = new Figure(facts.moving, false);
    this.ghost = new Figure(facts.moving, true);
    this.world.add(this.body.group, this.ghost.group);
    this.lookAgain();
    this.resize();
  }

  /** In a flat scene that is wide, look at the part where one moves. */
  zoom(near: boolean): void {
    if (!this.facts?.near || this.near === near) return;
    this.near = near;
    this.lookAgain();
  }

  /** Look from where one looks at first. */
  lookAgain(): void {
    const view = this.facts?.view;
    if (!view) return;
    if (view.kind === "flat") {
      const centre = this.near ? this.facts!.near!.centre : view.centre;
      this.camera = new three.OrthographicCamera();
      this.camera.position.set(centre[0], centre[1], 10);
    } else {
      this.camera = new three.PerspectiveCamera(38, 1, 0.01, 50);
      this.camera.up.set(0, 0, 1);
      const eye = new three.Vector3(...view.position);
      this.orbit.target.set(...view.target);
      eye.sub(this.orbit.target);
      this.orbit.far = eye.length();
      this.orbit.tilt = Math.asin(eye.z / this.orbit.far);
      this.orbit.turn = Math.atan2(eye.y, eye.x);
    }
    this.resize();
  }

  /** Turn and tilt the view, in radians, and move nearer by a factor. */
  turn(right: number, up: number, nearer = 1): void {
    this.orbit.turn -= right;
    this.orbit.tilt = Math.min(1.5, Math.max(-0.1, this.orbit.tilt + up));
    this.orbit.far = Math.min(6, Math.max(0.5, this.orbit.far / nearer));
    this.change();
  }

  get flat(): boolean {
    return this.facts?.view.kind === "flat";
  }

  /** Where the scene's points are; with a ghost beside them, or none. */
  pose(points: number[][], ghost: number[][] | null = null): void {
    if (!this.body || !this.ghost || !points.length) return;
    this.points = points;
    this.body.place(points);
    if (ghost) this.ghost.place(ghost);
    this.ghost.group.visible = ghost !== null;
    this.change();
  }

  get handle(): Place | null {
    const place = this.facts ? this.points[this.facts.handle] : undefined;
    return place ? [place[0], place[1], place[2]] : null;
  }

  /** What is aimed at. */
  aim(shapes: unknown[]): void {
    this.goals.clear();
    for (const shape of shapes as Shape[]) this.goals.add(this.fixed(shape));
    this.change();
  }

  /** Where a place is in the page, in pixels. */
  pixel(place: Place): [number, number] {
    this.look();
    const at = new three.Vector3(...place).project(this.camera);
    const box = this.renderer.domElement.getBoundingClientRect();
    return [
      box.left + ((at.x + 1) / 2) * box.width,
      box.top + ((1 - at.y) / 2) * box.height,
    ];
  }

  /** Whether a pointer there would grasp the handle. */
  grasps(x: number, y: number): boolean {
    if (!this.handle) return false;
    const [hx, hy] = this.pixel(this.handle);
    return this.flat || Math.hypot(x - hx, y - hy) < GRASP;
  }

  /** The place under a pointer, in a plane through a place: facing the camera, level or upright. */
  under(x: number, y: number, plane: string, through: Place): Place | null {
    this.look();
    const box = this.renderer.domElement.getBoundingClientRect();
    const at = new three.Vector2(
      (2 * (x - box.left)) / box.width - 1,
      1 - (2 * (y - box.top)) / box.height,
    );
    const ray = new three.Raycaster();
    ray.setFromCamera(at, this.camera);
    const normal = this.normal(this.flat ? "level" : plane);
    const cut = new three.Plane().setFromNormalAndCoplanarPoint(
      normal,
      new three.Vector3(...through),
    );
    const found = ray.ray.intersectPlane(cut, new three.Vector3());
    return found ? [found.x, found.y, found.z] : null;
  }

  /** A step to the right and up on the screen, in a plane; for the keyboard. */
  step(right: number, up: number, plane: string): Place {
    const ahead = new three.Vector3();
    this.look();
    this.camera.getWorldDirection(ahead);
    const across = new three.Vector3().crossVectors(ahead, this.camera.up).normalize();
    const rise = this.normal(this.flat ? "level" : plane).clone();
    const upward = new three.Vector3().crossVectors(across, rise).normalize();
    if (upward.dot(this.flat ? UP : plane === "level" ? ahead : new three.Vector3(0, 0, 1)) < 0)
      upward.negate();
    across.multiplyScalar(right).addScaledVector(upward, up);
    return [across.x, across.y, across.z];
  }

  private normal(plane: string): three.Vector3 {
    if (plane === "level") return new three.Vector3(0, 0, 1);
    const ahead = new three.Vector3();
    this.camera.getWorldDirection(ahead);
    if (plane === "upright") ahead.z = 0;
    return ahead.normalize();
  }

  private fixed(shape: Shape): three.Object3D {
    const colour = COLOURS[shape.colour] ?? COLOURS.dark;
    const places = (shape.places ?? []).map((place) => new three.Vector3(...place));
    const [first, last] = [places[0], places[places.length - 1]];
    const middle = first.clone().add(last).multiplyScalar(0.5);
    const size = last.clone().sub(first);
    const solid = new three.MeshLambertMaterial({ color: colour });
    if (shape.shape === "sheet") return this.sheet(colour, middle, size);
    if (shape.shape === "block") {
      const box = new three.BoxGeometry(Math.abs(size.x), Math.abs(size.y), Math.abs(size.z));
      const mesh = new three.Mesh(box, solid);
      mesh.position.copy(middle);
      return mesh;
    }
    const flat = new three.MeshBasicMaterial({ color: colour, side: three.DoubleSide });
    if (shape.shape === "ring" || shape.shape === "spot") {
      const geometry =
        shape.shape === "ring"
          ? new three.RingGeometry(shape.radius * 0.72, shape.radius, 48)
          : new three.CircleGeometry(shape.radius, 32);
      const mesh = new three.Mesh(geometry, flat);
      mesh.position.copy(first);
      return mesh;
    }
    const length = size.length();
    const rod = new three.CylinderGeometry(shape.radius, shape.radius, 1, 20);
    const mesh = new three.Mesh(rod, shape.shape === "pillar" ? solid : flat);
    mesh.position.copy(middle);
    mesh.scale.set(1, Math.max(length, 1e-6), 1);
    mesh.quaternion.setFromUnitVectors(UP, size.normalize());
    return mesh;
  }

  private sheet(colour: string, middle: three.Vector3, size: three.Vector3): three.Object3D {
    const group = new three.Group();
    const material = new three.MeshBasicMaterial({
      color: colour,
      transparent: true,
      opacity: 0.75,
      side: three.DoubleSide,
      depthWrite: false,
    });
    const mesh = new three.Mesh(new three.PlaneGeometry(size.x, size.y), material);
    const grid = new three.GridHelper(Math.max(size.x, size.y), 11, 0x9fb4c0, 0xc9d8e0);
    grid.rotation.x = Math.PI / 2;
    group.add(mesh, grid);
    group.position.copy(middle);
    this.water.push(mesh);
    return group;
  }

  private look(): void {
    if (this.camera instanceof three.PerspectiveCamera) {
      const { turn, tilt, far, target } = this.orbit;
      this.camera.position.set(
        target.x + far * Math.cos(tilt) * Math.cos(turn),
        target.y + far * Math.cos(tilt) * Math.sin(turn),
        target.z + far * Math.sin(tilt),
      );
      this.camera.lookAt(target);
    }
    this.camera.updateMatrixWorld();
  }

  private resize(): void {
    const width = Math.max(1, this.box.clientWidth);
    const height = Math.max(1, this.box.clientHeight);
    this.renderer.setSize(width, height, false);
    const view = this.facts?.view;
    if (this.camera instanceof three.PerspectiveCamera) {
      this.camera.aspect = width / height;
      // On a narrow screen the scene's width decides, not its height.
      this.camera.fov = width >= height ? 38 : Math.min(70, (38 * height) / width);
    } else if (view?.kind === "flat") {
      const size = this.near ? this.facts!.near!.size : view.size;
      const scale = Math.max(size[0] / width, size[1] / height);
      Object.assign(this.camera, {
        left: (-scale * width) / 2,
        right: (scale * width) / 2,
        top: (scale * height) / 2,
        bottom: (-scale * height) / 2,
      });
    }
    this.camera.updateProjectionMatrix();
    this.change();
  }

  private change(): void {
    if (this.dirty) return;
    this.dirty = true;
    requestAnimationFrame(() => {
      this.dirty = false;
      this.drawn += 1;
      this.look();
      this.renderer.render(this.world, this.camera);
    });
  }
}
