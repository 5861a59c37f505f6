// Looks at a page from within, as a reader would: is everything in its place, and does it answer to pointer and buttons?
addEventListener("load", () => setTimeout(() => {
  const faults = window.probeFaults, must = (holds, what) => { if (!holds) faults.push(what); };
  const said = (text) => (text || "").trim().slice(0, 40);
  const boxes = (nodes) => [...nodes].map((node) => [node, node.getBoundingClientRect()]).filter(([, b]) => b.width > 0 && b.height > 0);
  const over = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1.5;

  must(performance.getEntriesByType("resource").length === 0, "something is fetched");
  must(document.documentElement.scrollWidth <= innerWidth + 1, `the page is ${document.documentElement.scrollWidth} wide on ${innerWidth}`);
  for (const svg of document.querySelectorAll("svg")) {
    const frame = svg.getBoundingClientRect();
    // labels that stand upright or aslant have larger boxes than ink
    const labels = boxes([...svg.querySelectorAll("text")].filter((text) => !/rotate/.test(text.getAttribute("transform") || "")));
    labels.forEach(([text, box], i) => {
      must(box.left >= frame.left - 2 && box.right <= frame.right + 2, `"${said(text.textContent)}" is cut off`);
      labels.slice(i + 1).forEach(([other, room]) => must(!over(box, room), `"${said(text.textContent)}" lies over "${said(other.textContent)}"`));
    });
  }
  const buttons = boxes(document.querySelectorAll("button"));
  buttons.forEach(([button, box], i) => {
    must(button.scrollWidth <= button.clientWidth + 1, `button "${said(button.textContent)}" is too narrow`);
    buttons.slice(i + 1).forEach(([other, room]) => must(!over(box, room), `button "${said(button.textContent)}" lies over "${said(other.textContent)}"`));
  });

  const keys = [...document.querySelectorAll("#keys button")];
  if (keys.length) {
    const first = document.querySelector("#panels svg"), marks = () => first.querySelectorAll(".mark").length;
    const key = keys.find((k) => k.getAttribute("aria-pressed") === "true"), before = marks();
    must(before > 0, "the first diagram has no marks");
    key.click();
    must(key.getAttribute("aria-pressed") === "false" && marks() < before, "a line is not hidden by its key");
    key.click();
    must(key.getAttribute("aria-pressed") === "true" && marks() === before, "a hidden line does not come back");

    const spot = first.querySelector(".mark").getBoundingClientRect(), at = { clientX: spot.left + spot.width / 2, clientY: spot.top + spot.height / 2, bubbles: true };
    const words = first.parentElement.querySelector(".said"), ring = first.querySelector(".chosen");
    first.dispatchEvent(new PointerEvent("pointermove", at));
    must(said(words.textContent) !== "" && ring.getAttribute("visibility") === "visible", "nothing is said under the pointer");
    first.dispatchEvent(new PointerEvent("pointerleave", at));
    must(said(words.textContent) === "", "what was said stays when the pointer leaves");
  }

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
}, 200));
