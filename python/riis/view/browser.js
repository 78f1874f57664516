// SPDX-License-Identifier: Apache-2.0
// The picture of riis view in the browser. It sends gestures to the server, and acknowledges pictures. Gestures add up while the
// server answers, so that a slow server skips pictures and never lags behind the hand.
"use strict";
(() => {
  let image = null, busy = false, gesture = null, ended = false, start = null, acknowledged = 0;

  // Tells whether the server answered. It cannot while the connection is lost, or is being made again.
  const send = async (name, ...values) => {
    try {
      await window.trame.trigger(name, values);
      return true;
    } catch (error) {
      if (window.trame.client?.isConnected()) throw error;
      return false;
    }
  };

  async function sendGesture() {
    if (busy) return;
    busy = true;
    try {
      while (gesture || ended) {
        if (gesture) {
          const { kind, dx, dy, shift } = gesture;
          gesture = null;
          await send("riis_gesture", kind, dx, dy, shift);
        } else {  // the last gesture was sent before this
          ended = false;
          await send("riis_gesture_ends");
        }
      }
    } finally {
      busy = false;
    }
  }

  function end() {
    if (start && start.moved) {
      ended = true;
      sendGesture();
    }
    start = null;
  }

  // dx and dy are parts of the picture's height, upwards and to the right.
  function add(kind, dx, dy, shift) {
    if (gesture && gesture.kind === kind) {
      gesture = { kind, dx: gesture.dx + dx, dy: gesture.dy + dy, shift };
    } else {
      gesture = { kind, dx, dy, shift };
    }
    sendGesture();
  }

  // The picture keeps its proportions. If another browser has set its size, there are stripes beside it, or above and below it.
  function shape() {
    const scale = Math.min(image.clientWidth / image.naturalWidth, image.clientHeight / image.naturalHeight);
    const width = scale * image.naturalWidth, height = scale * image.naturalHeight;
    return { width, height, left: (image.clientWidth - width) / 2, top: (image.clientHeight - height) / 2 };
  }

  // A picture may be loaded before its number arrives. The number is then acknowledged when it is looked at again.
  async function acknowledge() {
    const number = image ? Number(image.dataset.number) : acknowledged;
    if (number === acknowledged || !image.complete) return;
    acknowledged = number;
    if (!await send("riis_seen", number)) acknowledged = 0;
  }
  setInterval(acknowledge, 250);

  function attach(element) {
    image = element;
    image.addEventListener("load", acknowledge);
    image.addEventListener("dragstart", (event) => event.preventDefault());
    image.addEventListener("contextmenu", (event) => event.preventDefault());
    image.addEventListener("pointerdown", (event) => {
      image.setPointerCapture(event.pointerId);
      start = { x: event.offsetX, y: event.offsetY, lastX: event.offsetX, lastY: event.offsetY, moved: false };
      start.kind = event.button === 2 || event.button === 1 || event.ctrlKey ? "pan" : "tool";
      event.preventDefault();
    });
    image.addEventListener("pointermove", (event) => {
      if (!start) return;
      if (!start.moved && Math.hypot(event.offsetX - start.x, event.offsetY - start.y) < 4) return;
      start.moved = true;
      const height = shape().height;
      add(start.kind, (event.offsetX - start.lastX) / height, (start.lastY - event.offsetY) / height, event.shiftKey);
      start.lastX = event.offsetX;
      start.lastY = event.offsetY;
    });
    image.addEventListener("pointerup", (event) => {
      if (start && !start.moved && start.kind === "tool") {
        const { left, top, width, height } = shape();
        send("riis_click", (event.offsetX - left) / width, 1 - (event.offsetY - top) / height);
      }
      end();
    });
    image.addEventListener("pointercancel", end);
    image.addEventListener("wheel", (event) => {
      add("zoom", 0, -event.deltaY / 1000, false);
      event.preventDefault();
    }, { passive: false });
    new ResizeObserver(() => {
      if (image.parentElement) send("riis_size", image.parentElement.clientWidth, image.parentElement.clientHeight);
    }).observe(image.parentElement);
  }

  window.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.target.matches("input, textarea")) return;
    const key = event.key.toLowerCase();  // with Shift it is "Z"
    if (key === "z") send(event.shiftKey ? "riis_redo" : "riis_undo");
    else if (key === "y") send("riis_redo");
    else return;
    event.preventDefault();
  });

  new MutationObserver(() => {
    const found = document.getElementById("riis-picture");
    if (found && found !== image) attach(found);
  }).observe(document.documentElement, { childList: true, subtree: true });
})();
