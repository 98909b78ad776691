// What a user does: buttons, keys and pointers, and what each changes.

const KEYS = [
  ["space", "play or stop"],
  ["← →", "a step back or on; with shift 100"],
  ["page up, page down", "the round before or after"],
  ["home, end", "the first or last frame"],
  ["+ −", "faster or slower"],
  ["G", "another ground"],
  ["A S P", "arrows, sonars, earlier paths"],
  ["Z, shift Z", "nearer or farther; drag to move"],
  ["[ ]", "another heading there"],
  ["escape", "let go of the cell pointed at"],
  ["D", "dark or light"],
];

/** Lets the page's controls move a Player. */
function listen(player) {
  const click = (id, action) => byId(id).addEventListener("click", action);
  click("play", () => player.play(!player.playing));
  click("back", () => player.stepBy(-1));
  click("forward", () => player.stepBy(1));
  click("previous", () => player.roundBy(-1));
  click("next", () => player.roundBy(1));
  click("nearer", () => player.zoomBy(2));
  click("farther", () => player.zoomBy(0.5));
  click("theme", () => player.setTheme(player.theme === "dark" ? "light" : "dark"));
  click("help", () => byId("keys").showModal());
  click("keys", () => byId("keys").close());
  byId("scrub").addEventListener("input", () => player.show(Number(byId("scrub").value)));
  byId("speed").addEventListener("change", () => (player.speed = Number(byId("speed").value)));
  addEventListener("keydown", (event) => listenToKey(player, event));
  listenToPointer(player, byId("stage"));
}

function listenToPointer(player, stage) {
  const at = (event) => {
    const box = stage.getBoundingClientRect();
    return player.stage.pointAt(event.clientX - box.left, event.clientY - box.top);
  };
  stage.addEventListener("pointermove", (event) => {
    if (!player.pinned && event.pointerType !== "touch") player.point(at(event));
  });
  stage.addEventListener("pointerleave", () => {
    if (!player.pinned) player.point(null);
  });
  const drag = listenToDrag(player, stage);
  stage.addEventListener("click", (event) => {
    if (!drag.far) player.hold(at(event));
  });
  stage.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey) return; // as touch pads pinch
      event.preventDefault();
      player.zoomBy(2 ** (-event.deltaY / 100), at(event));
    },
    { passive: false },
  );
}

/** Dragging moves what is seen of the arena; `far` tells a drag from a click. */
function listenToDrag(player, stage) {
  const drag = { from: null, far: false };
  const moved = (event) => [event.clientX - drag.from.clientX, event.clientY - drag.from.clientY];
  stage.addEventListener("pointerdown", (event) => {
    drag.far = false;
    if (player.stage.zoom > 1) drag.from = event;
  });
  // It is drawn anew where it is let go: until then the picture itself is moved.
  stage.addEventListener("pointermove", (event) => {
    if (!drag.from) return;
    const [dx, dy] = moved(event);
    drag.far ||= Math.hypot(dx, dy) > 4;
    if (drag.far) stage.style.transform = `translate(${dx}px, ${dy}px)`;
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"]) {
    stage.addEventListener(end, (event) => {
      if (!drag.from) return;
      if (drag.far) player.stage.pan(...moved(event));
      stage.style.transform = "";
      drag.from = null;
      player.render();
    });
  }
  return drag;
}

function listenToKey(player, event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  const many = event.shiftKey ? 100 : 1;
  const actions = {
    " ": () => player.play(!player.playing),
    ArrowLeft: () => player.stepBy(-many),
    ArrowRight: () => player.stepBy(many),
    PageUp: () => player.roundBy(-1),
    PageDown: () => player.roundBy(1),
    Home: () => player.show(0),
    End: () => player.show(player.run.frames - 1),
    "+": () => player.setSpeed(1),
    "=": () => player.setSpeed(1),
    "-": () => player.setSpeed(-1),
    g: () => byId("ground") && player.setLayers({ ground: player.nextGround() }),
    a: () => byId("layer-arrows")?.click(),
    s: () => byId("layer-sonars")?.click(),
    p: () => byId("layer-paths")?.click(),
    "[": () => player.turn(1),
    "]": () => player.turn(-1),
    Escape: () => player.letGo(),
    z: () => player.zoomBy(event.shiftKey ? 0.5 : 2),
    d: () => byId("theme").click(),
    "?": () => byId("help").click(),
  };
  const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action || byId("keys").open) return;
  if (event.target.tagName === "BUTTON" && event.key === " ") event.target.blur();
  event.preventDefault();
  action();
}
