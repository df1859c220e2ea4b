"use strict";
for (const card of document.querySelectorAll(".card")) {
  const stage = card.querySelector(".stage");
  const over = stage.querySelector(".over");
  const slider = card.querySelector("input[type=range]");
  const flicker = card.querySelector(".flicker");
  const tabs = [...card.querySelectorAll(".tabs button")];
  let timer = 0;

  function wipe(percent) {
    stage.style.setProperty("--wipe", percent + "%");
    stage.classList.toggle("plain", percent <= 0 || percent >= 100);
  }

  function stop() {
    clearInterval(timer);
    timer = 0;
    flicker.setAttribute("aria-pressed", "false");
    over.hidden = false;
  }

  // the picture is "", any other view its number; it covers the picture
  function show(view) {
    stop();
    for (const image of stage.querySelectorAll(".view")) image.hidden = image.dataset.view !== view;
    for (const tab of tabs) tab.setAttribute("aria-pressed", String(tab.dataset.show === view));
    const chosen = tabs.find((tab) => tab.dataset.show === view);
    card.querySelector(".legend").textContent = chosen.dataset.legend || "\u00a0";
    card.querySelector(".controls").style.visibility = view === "" ? "visible" : "hidden";
    if (view === "") wipe(Number(slider.value));
    else stage.classList.add("plain");
  }

  slider.addEventListener("input", () => { stop(); wipe(Number(slider.value)); });
  for (const tab of tabs) tab.addEventListener("click", () => show(tab.dataset.show));
  flicker.addEventListener("click", () => {
    if (timer) { stop(); wipe(Number(slider.value)); return; }
    wipe(100);
    flicker.setAttribute("aria-pressed", "true");
    timer = setInterval(() => { over.hidden = !over.hidden; }, 400);
  });
}
// in a narrow window a plot is large or whole; the tapped place comes to the middle
for (const plot of document.querySelectorAll(".plot")) {
  plot.addEventListener("click", (event) => {
    const place = event.offsetX / plot.clientWidth;
    plot.classList.toggle("large");
    const box = plot.parentElement;
    box.scrollLeft = place * plot.clientWidth - box.clientWidth / 2;
  });
}
