// Shows the view alone at the size of the picture, a third into the run or where the address says, and leaves it as text.
(async () => {
  const report = document.createElement("pre");
  report.id = "report";
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  try {
    while (document.documentElement.dataset.ready !== "yes") await wait(20);
    const { view, clock } = window.mbsPage, stage = document.querySelector("#view .stage");
    Object.assign(stage.style, { width: "{{width}}px", height: "{{height}}px", maxWidth: "none", minHeight: "0", aspectRatio: "auto" });
    for (let k = 0; k < 200 && view.canvas.width !== Number("{{width}}"); k++) await wait(20);
    const asked = new URLSearchParams("{{look}}");
    if (asked.has("follow")) view.setFollowed(window.mbsPage.motion.bodies.findIndex((body) => body.name === asked.get("follow")));
    clock.seek(asked.has("t") ? Number(asked.get("t")) : clock.start + (clock.end - clock.start) / 3);
    if (asked.has("view")) view.setSide(asked.get("view"));
    view.fit();
    await wait(100);
    view.draw();
    report.textContent = view.canvas.toDataURL("image/png");
  } catch (error) { report.textContent = String(error); }
  document.body.append(report);
})();
