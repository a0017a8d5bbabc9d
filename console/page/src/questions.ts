// Questions of one kind to the console: an answer counts until the next question is asked, whichever comes first.

export class Questions {
  private asked = 0;

  // Whether no other one has been asked since.
  ask(): () => boolean {
    const number = ++this.asked;
    return () => number === this.asked;
  }
}
