// Puts a page together: reads its data, makes one clock for the view and all plots, and draws.
const MANY_PLOTS = 12;

// The library is a text like the data; it becomes a script of the page.
async function loadThree() {
  const script = document.createElement("script");
  script.textContent = new TextDecoder().decode(await inflated("three")) + ";window.mbsThree = T;";
  document.head.appendChild(script);
  return window.mbsThree;
}

function hasWebGL() {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return Boolean(context);
}

async function showMotion(motion, clock) {
  const section = document.getElementById("view");
  if (!hasWebGL()) return makeLines(motion, clock, section);
  try {
    return makeView(await loadThree(), motion, clock, section);
  } catch (error) {
    console.warn(error);
    const old = section.querySelector("canvas.scene"), fresh = old.cloneNode();
    old.replaceWith(fresh);
    return makeLines(motion, clock, section);
  }
}

function connect(view, motion, clock) {
  const by = (id) => document.getElementById(id), section = by("view");
  by("follow").add(new Option("nothing", ""));
  motion.bodies.forEach((body, i) => by("follow").add(new Option(body.name, i)));
  by("follow").value = view.followed() ?? "";
  by("follow").addEventListener("change", () => {
    const body = by("follow").value;
    view.setFollowed(body === "" ? null : Number(body));
    writeAddress({ follow: body === "" ? "nothing" : motion.bodies[body].name });
  });
  const turn = (side) => { if (side === "fit") view.fit(); else { view.setSide(side); writeAddress({ view: side }); } };
  section.querySelectorAll("[data-side]").forEach((button) => button.addEventListener("click", () => turn(button.dataset.side)));
  if (motion.dimension === 2) section.querySelectorAll("[data-side]:not([data-side=fit])").forEach((button) => { button.hidden = true; });
  const name = (on) => { by("names").checked = on; view.setNames(on); };
  by("names").addEventListener("change", () => name(by("names").checked));
  by("names").closest("label").hidden = view.kind === "lines";
  by("forces").closest("label").hidden = !motion.forces.length;
  by("forces").addEventListener("input", () => view.setForces(Number(by("forces").value)));
  by("full").addEventListener("click", () => (document.fullscreenElement ? document.exitFullscreen() : section.requestFullscreen?.()));
  by("picture").addEventListener("click", () => view.picture((blob) => saveBlob(blob, "motion.png")));
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
    const side = { 1: "side", 2: "front", 3: "top", 4: "rear", f: "fit" }[event.key];
    if (side) turn(side);
    else if (event.key === "l") name(!by("names").checked);
  });
  if (motion.is_named) name(true);
  // a single picture does not move
  if (motion.times.length < 2) section.querySelector(".controls").hidden = true;
  else recordVideo(view, clock, by("video"));
  const obey = () => {
    const asked = readAddress(), body = motion.bodies.findIndex((b) => b.name === asked.follow);
    if (asked.follow !== undefined) { view.setFollowed(body < 0 ? null : body); by("follow").value = body < 0 ? "" : body; }
    clock.seek(Number.isFinite(Number(asked.t)) ? Number(asked.t) : clock.start);
    view.setSide(asked.view);
  };
  addEventListener("hashchange", obey);
  obey();
}

function saveBlob(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
}

function recordVideo(view, clock, button) {
  if (!window.MediaRecorder || !view.canvas.captureStream) return;
  button.hidden = false;
  let recorder = null;
  button.addEventListener("click", () => {
    if (recorder) { recorder.stop(); return; }
    const parts = [];
    recorder = new MediaRecorder(view.canvas.captureStream(30));
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () => { recorder = null; button.textContent = "Record video"; saveBlob(new Blob(parts, { type: "video/webm" }), "motion.webm"); };
    recorder.start();
    button.textContent = "Stop recording";
  });
}

// A field that searches the plots, where there are many.
function makePicker(parent, plots) {
  if (plots.length <= MANY_PLOTS) return;
  const bar = document.createElement("div"), field = document.createElement("input"), all = document.createElement("button"), count = document.createElement("span");
  bar.className = "controls picker";
  Object.assign(field, { type: "search", placeholder: `search ${plots.length} plots`, ariaLabel: "search plots" });
  Object.assign(all, { type: "button", textContent: `show all ${plots.length}` });
  let most = MANY_PLOTS;
  function pick() {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = plots.filter((plot) => words.every((word) => plot.title.includes(word)));
    plots.forEach((plot) => { plot.figure.hidden = true; });
    found.slice(0, most).forEach((plot) => { plot.figure.hidden = false; });
    count.textContent = found.length > most ? `${most} of ${found.length} are shown` : `${found.length} of ${plots.length}`;
  }
  field.addEventListener("input", pick);
  all.addEventListener("click", () => { most = plots.length; all.hidden = true; pick(); });
  bar.append(field, all, count);
  parent.before(bar);
  pick();
}

(async function main() {
  const section = document.getElementById("view");
  if (!window.DecompressionStream) {
    document.querySelectorAll("#view .stage, figure.graph").forEach((node) => { node.replaceChildren("This picture needs a newer browser."); });
    return;
  }
  const { header, column } = await readPack("pack");
  const panels = header.panels ?? [], motion = header.motion && makeMotion(header.motion, panels, column);
  if (motion?.road) motion.road.heights = motion.road.heights.map((c) => column(c));
  const ends = panels.flatMap((panel) => panel.lines.map((line) => column(line.t))).concat(motion ? [motion.times] : []).filter((t) => t.length);
  const start = Math.min(...ends.map((t) => t[0])), end = Math.max(...ends.map((t) => t[t.length - 1]));
  const clock = makeClock(ends.length ? [start, end > start ? end : start + 1] : [0, 1]), shared = makeWindow([clock.start, clock.end]);
  const plots = [...document.querySelectorAll("figure[data-panel]")].map((figure) => makePlot(figure, panels[figure.dataset.panel], column, clock, shared));
  const redrawDiagrams = header.diagrams ? makeDiagrams(header.diagrams) : () => {};
  document.querySelectorAll("main > .graphs").forEach((parent) => makePicker(parent, plots.filter((plot) => parent.contains(plot.figure))));
  let view = null, controls = null;
  if (motion) {
    view = await showMotion(motion, clock);
    controls = makeControls(clock, (motion.end - motion.start) / Math.max(1, motion.times.length - 1));
    connect(view, motion, clock);
  }
  const redraw = () => { view?.theme(); plots.forEach((plot) => plot.draw()); redrawDiagrams(); };
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  section?.setAttribute("data-drawn", view ? view.kind : "");
  // for tests, and for who wants to try something by hand
  window.mbsPage = { clock, shared, plots, view, controls, motion };
  document.documentElement.dataset.ready = "yes";
})();
