// Looks at a page from within, as a reader would: is everything in its place, and does it answer to pointer and buttons?
async function lookedAt() {
  const faults = window.probeFaults, must = (holds, what) => { if (!holds) faults.push(what); };
  const said = (text) => (text || "").trim().slice(0, 40);
  const boxes = (nodes) => [...nodes].map((node) => [node, node.getBoundingClientRect()]).filter(([, b]) => b.width > 0 && b.height > 0);
  const over = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1.5;

  // pages with data of their own are drawn when it is read
  for (let i = 0; i < 100 && document.getElementById("pack") && !document.documentElement.dataset.ready; i++) await new Promise((go) => setTimeout(go, 50));
  must(!document.getElementById("pack") || document.documentElement.dataset.ready, "the page is not drawn");
  if (window.probeTheme) must(matchMedia(`(prefers-color-scheme: ${window.probeTheme})`).matches, `the page is not ${window.probeTheme}`);
  must(performance.getEntriesByType("resource").length === 0, "something is fetched");
  must(document.documentElement.scrollWidth <= innerWidth + 1, `the page is ${document.documentElement.scrollWidth} wide on ${innerWidth}`);
  const labelled = () => {
    for (const svg of document.querySelectorAll("svg")) {
      const frame = svg.getBoundingClientRect();
      // labels that stand upright or aslant have larger boxes than ink
      const labels = boxes([...svg.querySelectorAll("text")].filter((text) => !/rotate/.test(text.getAttribute("transform") || "")));
      labels.forEach(([text, box], i) => {
        must(box.left >= frame.left - 2 && box.right <= frame.right + 2, `"${said(text.textContent)}" is cut off`);
        labels.slice(i + 1).forEach(([other, room]) => must(!over(box, room), `"${said(text.textContent)}" lies over "${said(other.textContent)}"`));
      });
    }
  };
  labelled();
  const buttons = boxes(document.querySelectorAll("button"));
  buttons.forEach(([button, box], i) => {
    must(button.scrollWidth <= button.clientWidth + 1, `button "${said(button.textContent)}" is too narrow`);
    buttons.slice(i + 1).forEach(([other, room]) => must(!over(box, room), `button "${said(button.textContent)}" lies over "${said(other.textContent)}"`));
  });

  const page = window.mbsPage, view = page?.view;
  if (view) {
    // the share of pixels that are not the background's, and a sum that changes with the picture
    const seen = () => {
      view.draw();
      const copy = document.createElement("canvas"), n = 200;
      copy.width = copy.height = n;
      const pencil = copy.getContext("2d");
      pencil.drawImage(view.canvas, 0, 0, n, n);
      const pixels = pencil.getImageData(0, 0, n, n).data;
      let drawn = 0, sum = 0;
      for (let i = 0; i < pixels.length; i += 4) {
        const differs = [0, 1, 2, 3].some((c) => Math.abs(pixels[i + c] - pixels[c]) > 6);
        if (differs) { drawn++; sum += i * (1 + pixels[i]); }
      }
      return [drawn / (n * n), sum];
    };
    must(view.kind === (window.probeWithoutWebGL ? "lines" : "three"), `the motion is drawn by ${view.kind}`);
    for (const shape of page.motion.shapes) must(shape.form !== "mesh" || shape.corners?.length > 0, "a mesh has no corners");
    page.clock.seek(page.clock.start);
    const [share, first] = seen();
    must(share > 0.002, `the motion fills ${share} of its canvas`);
    const moves = page.motion.times.length > 1;
    page.clock.seek(0.3 * page.clock.start + 0.7 * page.clock.end);
    must(!moves || seen()[1] !== first, "the picture is the same at two times");
    if (page.motion.forces.length) {
      const [, short] = seen();
      view.setForces(3);
      must(seen()[1] !== short, "longer arrows do not change the picture");
      view.setForces(1);
    }
    const [, still] = seen(), scroll = scrollY;
    view.canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -300, bubbles: true, cancelable: true }));
    await new Promise((go) => setTimeout(go, 100));
    must(seen()[1] !== still, "the wheel does not change the picture");
    must(scrollY === scroll, "the wheel scrolls the page");
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true }));
    must(!moves || page.controls.isPlaying(), "space does not play");
    page.controls.play(false);
  }
  if (page?.plots.length) {
    const { start, end } = page.clock, middle = (start + end) / 2;
    page.shared.set(start, middle);
    must(Math.abs(page.shared.span[1] - middle) < 1e-9 * (end - start), "a zoomed plot has another window");
    page.shared.reset();
    must(page.shared.span[0] === start && page.shared.span[1] === end, "the window does not come back");
  }

  const keys = [...document.querySelectorAll("#keys button")];
  if (keys.length) {
    const first = document.querySelector("figure[data-diagram] svg.plot"), marks = () => first.querySelectorAll(".mark").length;
    must(document.documentElement.scrollHeight <= (innerWidth > 1000 ? 4000 : 8000), `the page is ${document.documentElement.scrollHeight} high before a table is opened`);
    must(!first.parentElement.querySelector("#keys") || first.getBoundingClientRect().top < 200, "the diagram is not the first thing");
    const key = keys.find((k) => k.getAttribute("aria-pressed") === "true"), before = marks();
    must(before > 0, "the first diagram has no marks");
    key.click();
    must(key.getAttribute("aria-pressed") === "false" && marks() < before, "a line is not hidden by its key");
    key.click();
    must(key.getAttribute("aria-pressed") === "true" && marks() === before, "a hidden line does not come back");
  }
  for (const first of document.querySelectorAll("figure[data-diagram] svg.plot")) {
    const mark = first.querySelector(".mark"), spot = mark?.getBoundingClientRect();
    if (!spot?.width) continue;
    const at = { clientX: spot.left + spot.width / 2, clientY: spot.top + spot.height / 2, bubbles: true };
    const words = first.parentElement.querySelector(".said"), ring = first.querySelector(".chosen");
    first.dispatchEvent(new PointerEvent("pointermove", at));
    must(said(words.textContent) !== "" && ring.getAttribute("visibility") === "visible", "nothing is said under the pointer");
    first.dispatchEvent(new PointerEvent("pointerleave", at));
    must(said(words.textContent) === "", "what was said stays when the pointer leaves");
  }
  // what is folded is looked at too
  document.querySelectorAll("details").forEach((fold) => { fold.open = true; });
  await new Promise((go) => setTimeout(go, 300));
  must(document.documentElement.scrollWidth <= innerWidth + 1, `the opened page is ${document.documentElement.scrollWidth} wide on ${innerWidth}`);
  labelled();

  const files = [], make = URL.createObjectURL;
  URL.createObjectURL = (blob) => { files.push(blob); return make.call(URL, blob); };
  HTMLAnchorElement.prototype.click = () => {};
  document.querySelectorAll("button.save").forEach((button) => button.click());
  must(files.length === document.querySelectorAll("button.save").length, "a picture is not exported");
  Promise.all(files.map((file) => file.text())).then((texts) => {
    texts.forEach((text, i) => {
      const svg = new DOMParser().parseFromString(text, "image/svg+xml");
      must(!svg.querySelector("parsererror") && svg.querySelector("path, line, rect"), `exported picture ${i + 1} is none`);
      must(!/var\(--/.test(text.replace(/style="[^"]*var\(--[^"]*"/g, "")), `exported picture ${i + 1} needs the page's style`);
    });
    parent.postMessage({ probe: [...new Set(faults)].slice(0, 12) }, "*");
  });
}
addEventListener("load", () => setTimeout(() => lookedAt().catch((error) => parent.postMessage({ probe: [...window.probeFaults, error.stack] }, "*")), 200));
